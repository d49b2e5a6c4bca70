// SPDX-License-Identifier: GPL-3.0-or-later
import assert from "node:assert/strict";
import { test } from "node:test";
import { readFloat32, readUint16, readUint32 } from "../src/base64";
import { counted, duration, percent, plural, rounded } from "../src/numbers";

test("measured numbers have three digits", () => {
  assert.equal(rounded(0), "0");
  assert.equal(rounded(0.8475279744), "0.848");
  assert.equal(rounded(1.456612608308205e-14), "1.46e-14");
  assert.equal(rounded(1850.26), "1,850");
  assert.equal(rounded(3e9), "3e9");
  assert.equal(rounded(-0.5), "-0.5");
  assert.equal(rounded(16.253706783627642, 6), "16.2537");
});

test("counted numbers have all digits", () => {
  assert.equal(counted(0), "0");
  assert.equal(counted(1234567), "1,234,567");
  assert.equal(plural(1, "row"), "1 row");
  assert.equal(plural(2000, "row"), "2,000 rows");
});

test("a share is 0 or 100 % only if it is", () => {
  assert.equal(percent(0), "0 %");
  assert.equal(percent(1), "100 %");
  assert.equal(percent(1e-9), "< 0.1 %");
  assert.equal(percent(1 - 1e-9), "> 99.9 %");
  assert.equal(percent(0.5), "50.0 %");
});

test("times have their unit", () => {
  assert.equal(duration(2e-6), "2 µs");
  assert.equal(duration(0.0123), "12.3 ms");
  assert.equal(duration(2), "2 s");
});

test("base64 is little-endian", () => {
  assert.deepEqual([...readUint32(btoa("\x01\x00\x00\x00\x00\x01\x00\x00"))], [1, 256]);
  assert.deepEqual([...readUint16(btoa("\x10\x27"))], [10000]);
  assert.deepEqual([...readFloat32(btoa("\x00\x00\x80\x3f"))], [1]);
});
