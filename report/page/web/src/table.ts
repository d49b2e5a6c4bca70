// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that sort and filter, for mouse, keyboard and screen reader. Long ones show a page of
// rows at a time.
import { add, field, freshId, h, type Child } from "./dom";
import { counted } from "./numbers";

export type Cell = string | number | null;

export interface Column<Row> {
  key: string;
  label: string;
  title?: string;
  /** What is sorted by, and exactly what the data has. */
  value: (row: Row) => Cell;
  /** What is shown; absent: the value. */
  show?: (row: Row) => Child;
  /** Words that give the cell a colour: verdicts. */
  tone?: (row: Row) => string;
  /** Offers its values to choose from. */
  facet?: boolean;
}

export interface TableOptions<Row> {
  caption: string;
  columns: Column<Row>[];
  rows: Row[];
  /** Below a row once it is opened. */
  details?: (row: Row) => Child[];
  /** Enter or a click on the first cell of a row. */
  pick?: (row: Row) => void;
  pickLabel?: (row: Row) => string;
  sortBy?: { key: string; descending?: boolean };
  pageSize?: number;
}

const kPageSize = 50;

/** Numbers before nothing, and texts as people sort them. */
export function compareCells(a: Cell, b: Cell): number {
  if (a === null || b === null) return a === b ? 0 : a === null ? 1 : -1;
  if (typeof a === "number" && typeof b === "number") return a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

/** Rows in the order of a column; what it has no value for comes last either way. */
export function sortedRows<Row>(rows: Row[], column: Column<Row>, descending: boolean): Row[] {
  const keyed = rows.map((row, index) => ({ row, index, cell: column.value(row) }));
  keyed.sort((a, b) => {
    if (a.cell === null || b.cell === null)
      return compareCells(a.cell, b.cell) || a.index - b.index;
    return (descending ? -1 : 1) * compareCells(a.cell, b.cell) || a.index - b.index;
  });
  return keyed.map(({ row }) => row);
}

/** A text that need not be broken into lines. */
const isShort = (value: Cell): boolean => String(value ?? "").length <= 28;

/** Does a row have all words, wherever? */
export function hasWords<Row>(row: Row, columns: Column<Row>[], words: string[]): boolean {
  if (words.length === 0) return true;
  const text = columns
    .map((column) => String(column.value(row) ?? ""))
    .join("\u0000")
    .toLowerCase();
  return words.every((word) => text.includes(word));
}

export class Table<Row> {
  readonly element: HTMLElement;
  private readonly options: TableOptions<Row>;
  private readonly body = h("tbody");
  private readonly status = h("p", { class: "status", role: "status" });
  private readonly more = h("p", { class: "more" });
  private readonly headers = new Map<string, HTMLElement>();
  private sort: { key: string; descending: boolean } | null;
  private words: string[] = [];
  private readonly numeric = new Map<string, boolean>();
  private readonly facets = new Map<string, string>();
  private pages = 1;
  private current: Row | null = null;

  constructor(options: TableOptions<Row>) {
    this.options = options;
    this.sort = options.sortBy
      ? { key: options.sortBy.key, descending: options.sortBy.descending ?? false }
      : null;
    const table = h(
      "table",
      {},
      h("caption", {}, options.caption),
      h("thead", {}, h("tr", {}, ...options.columns.map((column) => this.header(column)))),
      this.body,
    );
    const scroller = h("div", {
      class: "scroll",
      tabindex: 0,
      role: "region",
      "aria-label": options.caption,
    });
    scroller.append(table);
    this.element = h("div", { class: "table" }, this.controls(), scroller, this.more);
    this.update();
  }

  /** Marks a row as the one that is shown elsewhere. */
  select(row: Row | null): void {
    this.current = row;
    this.update();
  }

  visibleRows(): Row[] {
    const { columns } = this.options;
    const rows = this.options.rows.filter(
      (row) =>
        hasWords(row, columns, this.words) &&
        columns.every((column) => {
          const wanted = this.facets.get(column.key);
          return wanted === undefined || String(column.value(row) ?? "") === wanted;
        }),
    );
    const sort = this.sort;
    const column = sort && columns.find(({ key }) => key === sort.key);
    return sort && column ? sortedRows(rows, column, sort.descending) : rows;
  }

  private controls(): HTMLElement {
    const id = freshId("filter");
    const input = h("input", {
      id,
      type: "search",
      placeholder: "words",
      oninput: () => {
        this.words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
        this.changed();
      },
    });
    const bar = h("div", { class: "controls" }, field(id, "Filter", input));
    for (const column of this.options.columns.filter(({ facet }) => facet)) {
      add(bar, this.facet(column));
    }
    bar.append(this.status);
    return bar;
  }

  private facet(column: Column<Row>): Child[] {
    const values = [...new Set(this.options.rows.map((row) => String(column.value(row) ?? "")))];
    if (values.length < 2) return [];
    values.sort((a, b) => compareCells(a, b));
    const id = freshId("facet");
    const select = h(
      "select",
      {
        id,
        onchange: () => {
          if (select.selectedIndex === 0) this.facets.delete(column.key);
          else this.facets.set(column.key, select.value);
          this.changed();
        },
      },
      h("option", {}, "all"),
      ...values.map((value) => h("option", { value }, value === "" ? "(none)" : value)),
    );
    return [field(id, column.label, select)];
  }

  private header(column: Column<Row>): HTMLElement {
    const button = h(
      "button",
      {
        type: "button",
        title: column.title,
        onclick: () => {
          const same = this.sort?.key === column.key;
          this.sort = { key: column.key, descending: same && !this.sort?.descending };
          this.changed();
        },
      },
      column.label,
    );
    const numeric = this.isNumeric(column);
    const cell = h(
      "th",
      { scope: "col", "data-key": column.key, class: numeric ? "number" : undefined },
      button,
    );
    this.headers.set(column.key, cell);
    return cell;
  }

  /** Has it numbers, besides what is missing? */
  private isNumeric(column: Column<Row>): boolean {
    const known = this.numeric.get(column.key);
    if (known !== undefined) return known;
    const found = this.options.rows.some((row) => typeof column.value(row) === "number");
    this.numeric.set(column.key, found);
    return found;
  }

  private changed(): void {
    this.pages = 1;
    this.update();
  }

  private update(): void {
    for (const [key, header] of this.headers) {
      if (this.sort?.key === key) {
        header.setAttribute("aria-sort", this.sort.descending ? "descending" : "ascending");
      } else {
        header.removeAttribute("aria-sort");
      }
    }
    const rows = this.visibleRows();
    const most = this.pages * (this.options.pageSize ?? kPageSize);
    const shown = rows.slice(0, most);
    this.body.replaceChildren(...shown.flatMap((row) => this.rowElements(row)));
    const all = this.options.rows.length;
    this.status.textContent =
      rows.length === all ? counted(all) : `${counted(rows.length)} of ${counted(all)}`;
    this.status.append(all === 1 ? " row" : " rows");
    this.more.replaceChildren();
    if (rows.length > shown.length) {
      add(this.more, [
        h(
          "button",
          {
            type: "button",
            onclick: () => {
              this.pages += 1;
              this.update();
            },
          },
          "Show more",
        ),
        ` ${counted(shown.length)} of ${counted(rows.length)} are shown`,
      ]);
    }
  }

  private rowElements(row: Row): HTMLElement[] {
    const { columns, details } = this.options;
    const opened = details ? details(row).filter(Boolean) : [];
    const detail = opened.length > 0 ? h("tr", { class: "details", hidden: true }) : null;
    detail?.append(h("td", { colspan: columns.length }, ...opened));
    const cells = columns.map((column, index) => this.cell(row, column, index === 0, detail));
    const element = h(
      "tr",
      { "aria-current": this.current === row ? "true" : undefined },
      ...cells,
    );
    return detail ? [element, detail] : [element];
  }

  private cell(row: Row, column: Column<Row>, first: boolean, detail: HTMLElement | null) {
    const value = column.value(row);
    const cell = h(first ? "th" : "td", {
      scope: first ? "row" : undefined,
      "data-key": column.key,
      "data-value": value === null ? "" : String(value),
      class: this.isNumeric(column) ? "number" : isShort(value) ? "short" : undefined,
      title: typeof value === "number" ? String(value) : undefined,
    });
    const content: Child = column.show ? column.show(row) : (value ?? "–");
    const tone = column.tone?.(row);
    const shown = tone ? h("span", { class: `tone ${tone}` }, content) : content;
    const { pick, pickLabel } = this.options;
    if (first && detail) {
      add(cell, [this.opener(detail, String(value ?? "")), shown]);
    } else if (first && pick) {
      const label = pickLabel?.(row);
      const button = h(
        "button",
        { type: "button", class: "pick", "aria-label": label, onclick: () => pick(row) },
        shown,
      );
      cell.append(button);
    } else {
      add(cell, [shown]);
    }
    return cell;
  }

  private opener(detail: HTMLElement, name: string): HTMLElement {
    detail.id = freshId("details");
    const button = h(
      "button",
      {
        type: "button",
        class: "opener",
        "aria-expanded": "false",
        "aria-controls": detail.id,
        "aria-label": `More of ${name}`,
        onclick: () => {
          detail.hidden = !detail.hidden;
          button.setAttribute("aria-expanded", String(!detail.hidden));
        },
      },
      "›",
    );
    return button;
  }
}
