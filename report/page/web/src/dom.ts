// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of the page, made without ever parsing text as HTML: whatever a scene is called, it is
// shown and not run.

export type Child = Node | string | number | null | undefined | false;
type Value = string | number | boolean | ((event: never) => void) | undefined;

/** An element with attributes; those that begin with "on" are listeners, `false` leaves one out. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, Value> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") {
      element.addEventListener(name.slice(2), value as EventListener);
    } else {
      element.setAttribute(name, value === true ? "" : String(value));
    }
  }
  add(element, children);
  return element;
}

export function add(to: Element, children: Child[]): void {
  for (const child of children) {
    if (child === null || child === undefined || child === false) continue;
    to.append(child instanceof Node ? child : String(child));
  }
}

/** A control with its label, which stay together. */
export function field(id: string, label: string, control: HTMLElement): HTMLElement {
  return h("span", { class: "field" }, h("label", { for: id }, label), control);
}

let lastId = 0;
/** An id that nothing else on the page has. */
export function freshId(prefix: string): string {
  lastId += 1;
  return `${prefix}-${lastId}`;
}

/** A part of the page under its heading. */
export function section(id: string, heading: string, ...children: Child[]): HTMLElement {
  const title = h("h2", { id: `${id}-title` }, heading);
  return h("section", { id, "aria-labelledby": title.id }, title, ...children);
}

/** A button that copies a command. */
export function command(text: string, label = "Copy"): HTMLElement {
  const button = h(
    "button",
    {
      type: "button",
      class: "copy",
      "aria-label": `Copy the command: ${text}`,
      onclick: () => {
        void copy(text).then((done) => {
          button.textContent = done ? "Copied" : "Select it";
          setTimeout(() => (button.textContent = label), 1500);
        });
      },
    },
    label,
  );
  return h("span", { class: "command" }, h("code", {}, text), button);
}

async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // Pages from disk have no clipboard in some browsers.
    const area = h("textarea", { class: "off-screen" });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}

/** The reader asked for no motion. */
export function wantsStillness(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
