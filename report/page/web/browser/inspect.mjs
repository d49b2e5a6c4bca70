// SPDX-License-Identifier: GPL-3.0-or-later
// What is looked at in every page, inside the browser: each function is sent there as it is.

/** Texts whose contrast to what is behind them is below 4.5, or 3 if they are large. */
export function lowContrast() {
  const channels = (text) => (text.match(/[\d.]+/g) ?? []).map(Number);
  const luminance = ([r, g, b]) => {
    const linear = [r, g, b].map((c) => {
      const x = c / 255;
      return x <= 0.03928 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const groundOf = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const [r, g, b, a = 1] = channels(getComputedStyle(at).backgroundColor);
      if (a > 0.5) return [r, g, b];
    }
    return [255, 255, 255];
  };
  const bad = [];
  for (const element of document.querySelectorAll("body *")) {
    const own = [...element.childNodes].some(
      (node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim() !== "",
    );
    if (!own || element.closest("svg, script, noscript, option, .off-screen")) continue;
    const style = getComputedStyle(element);
    if (style.visibility === "hidden" || element.getClientRects().length === 0) continue;
    const [a, b] = [luminance(channels(style.color)), luminance(groundOf(element))];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    const large = parseFloat(style.fontSize) >= 24;
    if (contrast < (large ? 3 : 4.5)) {
      bad.push(`${element.textContent.trim().slice(0, 40)}: ${contrast.toFixed(2)}`);
    }
  }
  return bad;
}

/** What a screen reader would have no name for, and structure that it would miss. */
export function withoutLabels() {
  const bad = [];
  const named = (element) =>
    element.getAttribute("aria-label") ||
    element.textContent.trim() ||
    (element.id && document.querySelector(`label[for="${element.id}"]`));
  for (const element of document.querySelectorAll("button, a, canvas, [role=img], [role=region]")) {
    if (!named(element)) bad.push(element.outerHTML.slice(0, 80));
  }
  for (const element of document.querySelectorAll("select, input")) {
    const label = element.id && document.querySelector(`label[for="${element.id}"]`);
    if (!label && !element.getAttribute("aria-label")) bad.push(element.outerHTML.slice(0, 80));
  }
  for (const table of document.querySelectorAll("table")) {
    if (!table.caption?.textContent.trim()) bad.push("a table without caption");
  }
  for (const header of document.querySelectorAll("th")) {
    if (!header.getAttribute("scope")) bad.push(`th without scope: ${header.textContent}`);
  }
  if (document.querySelectorAll("h1").length !== 1) bad.push("not one h1");
  if (!document.documentElement.lang) bad.push("no language");
  if (!document.title) bad.push("no title");
  const ids = [...document.querySelectorAll("[id]")].map(({ id }) => id);
  for (const id of ids) if (ids.indexOf(id) !== ids.lastIndexOf(id)) bad.push(`twice: ${id}`);
  return bad;
}

/** How many colours a picture has, of a raster of its points. */
export function coloursOf(url) {
  return new Promise((done) => {
    const image = new Image();
    image.onload = () => {
      const canvas = document.createElement("canvas");
      canvas.width = 160;
      canvas.height = 120;
      const context = canvas.getContext("2d");
      context.imageSmoothingEnabled = false;
      context.drawImage(image, 0, 0, 160, 120);
      const { data } = context.getImageData(0, 0, 160, 120);
      const colours = new Set();
      for (let i = 0; i < data.length; i += 4) {
        colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      }
      done(colours.size);
    };
    image.src = url;
  });
}

/** The cells of one column of a table, as the data has them. */
export function columnOf({ section, key }) {
  const rows = document.querySelectorAll(`#${section} tbody tr:not(.details)`);
  return [...rows].map((row) => row.querySelector(`[data-key="${key}"]`)?.dataset.value ?? null);
}
