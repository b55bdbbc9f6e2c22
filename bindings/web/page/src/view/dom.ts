// A short way to make elements.

type Child = Node | string;
type Properties = Record<string, string | number | boolean | ((event: Event) => void)>;

/** An element with attributes, listeners (`onclick`) and children. */
export function h<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[Name] {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (typeof value === "function") element.addEventListener(key.slice(2), value);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false) element.setAttribute(key, String(value));
  }
  element.append(...children);
  return element;
}

/** Sets the text of an element, and touches nothing if it is the same. */
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Something wide, which scrolls by itself where there is no room for it. */
export function scrolling(label: string, inner: HTMLElement): HTMLElement {
  return h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": label }, inner);
}

/** A menu with a label. */
export function menu(label: string, options: [string, string][], chosen: string, change: (value: string) => void): { element: HTMLElement; select: HTMLSelectElement } {
  const select = h("select", { onchange: () => change(select.value) });
  select.append(...options.map(([value, name]) => h("option", { value }, name)));
  select.value = chosen;
  return { element: h("label", { class: "field" }, h("span", {}, label), select), select };
}

/** A slider with a label and its value in words. */
export function slider(
  label: string,
  range: { min: number; max: number; step: number; value: number },
  words: (value: number) => string,
  change: (value: number) => void,
): { element: HTMLElement; input: HTMLInputElement; show: (value: number) => void } {
  const output = h("output", {}, words(range.value));
  const input = h("input", { type: "range", min: range.min, max: range.max, step: range.step });
  input.value = String(range.value);
  input.setAttribute("aria-valuetext", words(range.value));
  const show = (value: number) => {
    if (document.activeElement !== input || Number(input.value) !== value) input.value = String(value);
    say(output, words(value));
    input.setAttribute("aria-valuetext", words(value));
  };
  input.addEventListener("input", () => {
    show(Number(input.value));
    change(Number(input.value));
  });
  return { element: h("label", { class: "field wide" }, h("span", {}, label), input, output), input, show };
}
