// Elements in one line each. Texts are set as texts, never as HTML.
type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | undefined | ((e: never) => void)>;

function fill(e: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") e.addEventListener(name, value as unknown as EventListener);
    else e.setAttribute(name, value === true ? "" : String(value));
  }
  e.append(...children.filter((c): c is Node | string => c !== null && c !== undefined && c !== false));
}

export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const e = document.createElement(tag);
  fill(e, attributes, children);
  return e;
}

export function svg<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fill(e, attributes, children);
  return e;
}

/** A colour swatch: by the object model, which the content security policy allows. */
export function swatch(colour: string): HTMLElement {
  const s = el("span", { class: "swatch", "aria-hidden": "true" });
  s.style.background = colour;
  return s;
}

export function option(value: string, text: string, selected = false): HTMLOptionElement {
  const o = el("option", { value }, text);
  o.selected = selected;
  return o;
}

/** A label over its control. */
export function field(label: string, control: HTMLElement, note?: string): HTMLLabelElement {
  return el("label", { class: "field" }, el("span", {}, label), control, note ? el("small", {}, note) : null);
}
