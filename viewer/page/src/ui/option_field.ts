// One option as a control, made from the option table; what the server says against its value stands below it.
import type { Option } from "../data/api.ts";
import { title_of } from "../model/slicing.ts";
import { el, option as choice } from "./dom.ts";

export interface OptionField { element: HTMLElement; show: (value: string | undefined, standing: string) => void; complain: (message: string) => void }

const range_text = (o: Option) => (o.min !== undefined && o.min !== null && o.max !== undefined && o.max !== null ? `${o.min} to ${o.max}${o.unit ? ` ${o.unit}` : ""}` : o.unit);

/** `changed` hears the new text; undefined where the standing value shall hold again. */
export function option_field(o: Option, prefix: string, changed: (text: string | undefined) => void): OptionField {
  const id = `${prefix}-${o.name}`;
  const error = el("small", { class: "error", id: `${id}-error`, role: "alert", hidden: true });
  const describe = { id, "aria-describedby": `${id}-error`, title: [o.help, range_text(o)].filter(Boolean).join("; ") };
  let control: HTMLInputElement | HTMLSelectElement;
  let plain: string[] | null = null;
  if (!o.per_extruder && o.kind === "flag") plain = ["0", "1"];
  else if (!o.per_extruder && o.kind === "choice") plain = o.choices ?? [];
  if (plain) {
    const select = el("select", { ...describe, change: () => changed(select.value === "" ? undefined : select.value) });
    select.append(choice("", ""), ...plain.map((c) => choice(c, o.kind === "flag" ? (c === "1" ? "yes" : "no") : c)));
    control = select;
  } else {
    const input = el("input", { ...describe, type: "text", autocomplete: "off", spellcheck: "false", inputmode: o.kind === "integer" || o.kind === "number" ? "decimal" : undefined, change: () => changed(input.value.trim() === "" ? undefined : input.value.trim()) });
    control = input;
  }
  const unit = o.unit && !plain ? el("small", { class: "unit" }, o.unit) : null;
  const element = el("div", { class: "option" }, el("label", { for: id }, title_of(o.name)), el("span", { class: "control" }, control, unit), error);
  return {
    element,
    show(value, standing) {
      if (control instanceof HTMLSelectElement) {
        const word = o.kind === "flag" ? (standing === "1" ? "yes" : "no") : standing;
        control.options[0]!.textContent = `${word} (as profiled)`;
        control.value = value ?? "";
      } else {
        control.placeholder = standing;
        control.value = value ?? "";
      }
      element.classList.toggle("changed", value !== undefined);
    },
    complain(message) {
      error.textContent = message;
      error.hidden = message === "";
      if (message) { control.setAttribute("aria-invalid", "true"); control.scrollIntoView({ block: "center" }); control.focus(); } else control.removeAttribute("aria-invalid");
    },
  };
}
