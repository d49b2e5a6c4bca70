// SPDX-License-Identifier: GPL-3.0-or-later
// The documents of a page's file, and what the schema says of them.
import { readFileSync } from "node:fs";
import Ajv from "ajv";

const schema = JSON.parse(
  readFileSync(new URL("../schema/report.schema.json", import.meta.url), "utf8"),
);
const validate = new Ajv({ allErrors: true, allowUnionTypes: true }).compile(schema);

/** By name. */
export function documentsOf(file) {
  const documents = {};
  const pattern = /<script type="application\/json" id="gnomon-data-([^"]+)">\n(.*?)<\/script>/gs;
  for (const [, name, text] of readFileSync(file, "utf8").matchAll(pattern)) {
    documents[name] = JSON.parse(text);
  }
  return documents;
}

/** In sentences; none: they are what the schema says. */
export function schemaErrors(documents) {
  if (validate(documents)) return [];
  return validate.errors.slice(0, 10).map((error) => `${error.instancePath} ${error.message}`);
}
