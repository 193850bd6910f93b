// The height of the print, upright beside the picture: which layers are shown, and how much damage each holds. Two
// sliders on one track (lowest layer shown, layer at the cut); a click on the profile goes to that layer.
import type { Viewer } from "../viewer.ts";
import { el } from "./dom.ts";
import { amount } from "./words.ts";

export function layer_bar(viewer: Viewer): HTMLElement {
  const upper = el("input", { type: "range", min: 0, value: 0, class: "upper", "aria-label": "Layer", "aria-orientation": "vertical", id: "layer" });
  const lower = el("input", { type: "range", min: 0, value: 0, class: "lower", "aria-label": "Lowest layer shown", "aria-orientation": "vertical", id: "from-layer" });
  const canvas = el("canvas", { class: "profile", role: "img", "aria-label": "Smears and holes over the height" });
  const tip = el("div", { class: "tip", hidden: true });
  const label = el("output", { class: "layer-label", for: "layer" });
  const head = el("div", { class: "profile-head", "aria-hidden": "true" }, el("span", { class: "smear-text" }, "smear"), el("span", { class: "hole-text" }, "hole"));
  const bar = el("section", { class: "layer-bar", "aria-label": "Layers" }, label, head, el("div", { class: "tracks" }, canvas, el("div", { class: "dual" }, upper, lower)), tip);

  upper.addEventListener("input", () => viewer.go({ layer: Number(upper.value) }));
  lower.addEventListener("input", () => viewer.set_from(Number(lower.value)));
  const layer_under = (e: MouseEvent) => {
    const box = canvas.getBoundingClientRect(), n = viewer.first?.moves.layer_z.length ?? 1;
    return Math.max(0, Math.min(n - 1, Math.floor((1 - (e.clientY - box.top) / box.height) * n)));
  };
  canvas.addEventListener("click", (e) => viewer.go({ layer: layer_under(e) }));
  canvas.addEventListener("mousemove", (e) => {
    const audit = viewer.first?.audit, l = layer_under(e);
    tip.hidden = !audit;
    if (!audit) return;
    tip.textContent = `layer ${l + 1}: smear ${amount(audit.layer_smear[l]!)}, hole ${amount(audit.layer_hole[l]!)} mm³`;
    tip.style.top = `${e.clientY - bar.getBoundingClientRect().top}px`;
  });
  canvas.addEventListener("mouseleave", () => { tip.hidden = true; });

  let drawn = "";
  const sync = () => {
    const m = viewer.first?.moves;
    if (!m) { label.textContent = drawn = ""; canvas.width = canvas.height = 0; return; }
    upper.max = lower.max = String(m.layer_z.length - 1);
    upper.value = String(viewer.at.layer);
    lower.value = String(viewer.from_layer);
    const z = m.layer_z[viewer.at.layer]!;
    label.textContent = `${viewer.at.layer + 1} / ${m.layer_z.length}`;
    label.title = `${z.toFixed(2)} mm`;
    upper.setAttribute("aria-valuetext", `layer ${viewer.at.layer + 1} of ${m.layer_z.length}, ${z.toFixed(2)} mm`);
    lower.setAttribute("aria-valuetext", `from layer ${viewer.from_layer + 1}`);
  };
  const draw = () => {
    const side = viewer.first, box = canvas.getBoundingClientRect();
    const key = `${box.width} ${box.height} ${viewer.at.layer} ${viewer.from_layer} ${viewer.look.dark} ${viewer.sides.map((s) => s.name + (s.audit ? 1 : 0)).join()}`;
    if (!side || box.height < 10 || key === drawn) return;
    drawn = key;
    const ratio = window.devicePixelRatio;
    canvas.width = box.width * ratio;
    canvas.height = box.height * ratio;
    const c = canvas.getContext("2d")!, style = getComputedStyle(bar);
    c.scale(ratio, ratio);
    const n = side.moves.layer_z.length, height = box.height / n, middle = box.width / 2;
    c.fillStyle = style.getPropertyValue("--line");
    c.fillRect(middle - 0.5, 0, 1, box.height);
    const audits = viewer.sides.map((s) => s.audit).filter((a) => a !== null);
    const top = Math.max(1e-6, ...audits.map((a) => Math.max(a.layer_smear.reduce((x, y) => Math.max(x, y), 0), a.layer_hole.reduce((x, y) => Math.max(x, y), 0))));
    // The print compared with, as pale bars behind.
    const other = viewer.sides[1];
    if (other?.audit) for (let l = 0; l < other.moves.layer_z.length; l++) {
      const y = box.height * (1 - other.moves.layer_z[l]! / side.moves.layer_z[n - 1]!);
      const reach = (mm3: number) => Math.sqrt(mm3 / top) * (middle - 2);
      c.globalAlpha = 0.28;
      c.fillStyle = style.getPropertyValue("--smear");
      c.fillRect(middle - 1 - reach(other.audit.layer_smear[l]!), y, reach(other.audit.layer_smear[l]!), Math.max(1, height));
      c.fillStyle = style.getPropertyValue("--hole");
      c.fillRect(middle + 1, y, reach(other.audit.layer_hole[l]!), Math.max(1, height));
    }
    if (side.audit) for (let l = 0; l < n; l++) {
      c.globalAlpha = l <= viewer.at.layer && l >= viewer.from_layer ? 1 : 0.35;
      const y = box.height - (l + 1) * height, h = Math.max(1, height);
      const smear = Math.sqrt(side.audit.layer_smear[l]! / top) * (middle - 2), hole = Math.sqrt(side.audit.layer_hole[l]! / top) * (middle - 2);
      c.fillStyle = style.getPropertyValue("--smear");
      c.fillRect(middle - 1 - smear, y, smear, h);
      c.fillStyle = style.getPropertyValue("--hole");
      c.fillRect(middle + 1, y, hole, h);
    }
    c.globalAlpha = 1;
    c.fillStyle = style.getPropertyValue("--text");
    c.fillRect(0, Math.round(box.height - (viewer.at.layer + 0.5) * height), box.width, 1);
  };
  let asked = false;
  const later = () => { if (!asked) { asked = true; requestAnimationFrame(() => { asked = false; sync(); draw(); }); } };
  viewer.on(later);
  new ResizeObserver(later).observe(canvas);
  return bar;
}
