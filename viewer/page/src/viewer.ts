// The viewer: prints, the moment looked at, and how; widgets show it and change it, and hear of changes by `on`.
// A second print follows the first by height.
import * as THREE from "three";
import { box_of, type Audit, type Moves, type Summary } from "./data/print.ts";
import type { Source } from "./data/source.ts";
import { Marker } from "./draw/marker.ts";
import { PrintView, type Look } from "./draw/print_view.ts";
import { Stage } from "./draw/stage.ts";
import { after_move, later, layer_at, steps_of, time_at, type Moment } from "./model/moment.ts";
import { named } from "./ui/words.ts";

export interface Side {
  name: string; source: Source; summary: Summary; moves: Moves; view: PrintView; audit: Audit | null;
  trouble: string; // why there is no audit; empty where there is one, or will be
}
export type Change = "prints" | "moment" | "look" | "audit" | "selection" | "play";

const dark_query = window.matchMedia("(prefers-color-scheme: dark)");
const still_query = window.matchMedia("(prefers-reduced-motion: reduce)");

const trouble = (name: string, e: unknown) => named(name, e instanceof Error ? e.message : String(e));

export class Viewer {
  readonly stage: Stage;
  readonly sides: Side[] = [];
  readonly marker = new Marker();
  at: Moment = { layer: 0, step: 0, share: 0 };
  from_layer = 0;
  look: Look = { colouring: "extruder", rampart: "open", travel: false, idle: true, dark: dark_query.matches };
  playing = false;
  speed = 20;
  selected: { side: number; place: number } | null = null;
  private listeners: ((what: Change) => void)[] = [];
  private last_tick = 0;
  private generation = 0;

  constructor(canvas: HTMLCanvasElement) {
    this.stage = new Stage(canvas);
    this.paint_background();
    dark_query.addEventListener("change", () => { this.paint_background(); this.set_look({ dark: dark_query.matches }); });
  }

  on(listener: (what: Change) => void): void { this.listeners.push(listener); }
  get first(): Side | undefined { return this.sides[0]; }

  /** Shows those of these prints that can be read, and nothing else. `said` hears how far reading is, and at last why
   *  others cannot be read or audited. Throws where none can be read; what was shown before then stays. */
  async open(sources: { name: string; source: Source }[], said: (text: string, progress?: number) => void): Promise<void> {
    const generation = ++this.generation;
    const current = () => generation === this.generation;
    this.play(false);
    const read = await Promise.allSettled(sources.map(async ({ name, source }) => ({ name, source, ...(await source.drawn((t, p) => { if (current()) said(`${name}: ${t}`, p); })) })));
    await this.stage.ready;
    if (!current()) return;
    const loaded = read.flatMap((r) => (r.status === "fulfilled" ? [r.value] : []));
    const troubles = read.flatMap((r, k) => (r.status === "rejected" ? [trouble(sources[k]!.name, r.reason)] : []));
    if (loaded.length === 0 && troubles.length > 0) throw new Error(troubles.join("\n"));
    performance.mark("cleancolor moves here");
    this.select(null);
    for (const s of this.sides.splice(0)) s.view.dispose();
    for (const { name, source, summary, moves } of loaded) this.sides.push({ name, source, summary, moves, audit: null, trouble: "", view: new PrintView(summary, moves, this.stage, this.look) });
    const top_speed = Math.max(...this.sides.map((s) => s.view.top_speed));
    if (this.sides.length > 1) for (const s of this.sides) s.view.top_speed = top_speed;
    this.stage.views = this.sides.map((s) => s.view);
    this.from_layer = 0;
    if (this.first) {
      const layer = this.first.moves.layer_z.length - 1;
      this.at = { layer, step: steps_of(this.first.moves, layer), share: 0 };
      this.home();
      this.follow();
    }
    this.emit("prints");
    await Promise.all(this.sides.map((s) => s.view.first_picture));
    if (!current()) return;
    performance.mark("cleancolor first picture");
    await Promise.all([...this.sides].map(async (side) => {
      try {
        const audit = await side.source.audited((t, p) => { if (current()) said(t, p); });
        if (!current()) return;
        side.audit = audit;
        side.view.set_audit(audit);
      } catch (e) {
        troubles.push((side.trouble = trouble(side.name, e)));
      }
      if (current()) this.emit("audit");
    }));
    if (current()) said(troubles.join("\n"));
  }

  set_look(look: Partial<Look>): void {
    this.look = { ...this.look, ...look };
    for (const s of this.sides) s.view.set_look(this.look);
    this.emit("look");
  }

  /** The moment of the first print; others follow by height. */
  go(at: Partial<Moment>): void {
    const m = this.first?.moves;
    if (!m) return;
    const layer = Math.max(0, Math.min(m.layer_z.length - 1, at.layer ?? this.at.layer));
    const all = steps_of(m, layer);
    const step = Math.max(0, Math.min(all, at.step ?? (at.layer === undefined ? this.at.step : all)));
    this.at = { layer, step, share: at.share ?? 0 };
    this.from_layer = Math.min(this.from_layer, layer);
    this.follow();
    this.emit("moment");
  }

  set_from(layer: number): void {
    this.from_layer = Math.max(0, Math.min(this.at.layer, layer));
    this.follow();
    this.emit("moment");
  }

  time_s(): number { return this.first ? time_at(this.first.moves, this.at) : 0; }

  play(playing: boolean): void {
    const m = this.first?.moves;
    if (!m || playing === this.playing) return;
    if (playing && this.at.layer === m.layer_z.length - 1 && this.at.step >= steps_of(m, this.at.layer)) this.go({ layer: 0, step: 0 });
    else if (playing && this.at.step >= steps_of(m, this.at.layer)) this.go({ layer: this.at.layer, step: 0 });
    this.playing = playing;
    this.last_tick = performance.now();
    if (playing) requestAnimationFrame(() => this.tick());
    this.emit("play");
  }

  /** Goes to a place of damage: sliders, camera, marker. */
  select(place: { side: number; place: number } | null): void {
    this.selected = place;
    this.marker.object.removeFromParent();
    const side = place && this.sides[place.side];
    if (!side?.audit || !place) { this.emit("selection"); this.stage.ask(); return; }
    const { places } = side.audit, k = place.place;
    const at = after_move(side.moves, places.move[k]!);
    if (place.side === 0) this.go(at);
    else this.go({ layer: layer_at(this.first!.moves.layer_z, side.moves.layer_z[at.layer]!) });
    if (place.side > 0) this.show_side(side, at);
    const spot = new THREE.Vector3();
    for (const c of [0, 1, 2]) spot.setComponent(c, (places.from[3 * k + c]! + places.to[3 * k + c]!) / 2);
    this.marker.place(spot);
    this.stage.canvas.scrollIntoView({ block: "nearest" });
    side.view.scene.add(this.marker.object);
    this.fly_to(spot, side.summary);
    this.emit("selection");
  }

  /** The camera as at first: all of the print, from the front and above. */
  home(): void {
    const boxes = this.sides.map((s) => box_of(s.summary));
    const box = new THREE.Box3();
    for (const [low, high] of boxes) box.expandByPoint(new THREE.Vector3(...low)).expandByPoint(new THREE.Vector3(...high));
    const middle = box.getCenter(new THREE.Vector3()), radius = Math.max(12, box.getSize(new THREE.Vector3()).length() / 2);
    const { camera, controls } = this.stage;
    const n = Math.max(1, this.sides.length), { clientWidth: width, clientHeight: height } = this.stage.canvas, tall = this.stage.tall();
    const narrow = Math.min(1, (tall ? width : width / n) / Math.max(1, tall ? height / n : height));
    const distance = (1.0 * radius) / Math.sin((camera.fov * Math.PI) / 360) / Math.max(0.45, narrow);
    controls.target.copy(middle);
    camera.position.copy(middle).add(new THREE.Vector3(0.38, -0.86, 0.42).normalize().multiplyScalar(distance));
    camera.near = Math.max(0.5, distance / 200);
    camera.far = distance * 20;
    controls.update();
    this.stage.move();
  }

  private fly_to(spot: THREE.Vector3, summary: Summary): void {
    const { camera, controls } = this.stage;
    const [low, high] = box_of(summary);
    const outward = new THREE.Vector3(spot.x - (low[0] + high[0]) / 2, spot.y - (low[1] + high[1]) / 2, 0);
    if (outward.length() < 1) outward.set(0.3, -1, 0);
    const eye = outward.normalize().add(new THREE.Vector3(0, 0, 0.75)).normalize().multiplyScalar(58).add(spot);
    const from = camera.position.clone(), target = controls.target.clone(), start = performance.now();
    const lasts = still_query.matches || this.stage.counters.software ? 0 : 450;
    const step = () => {
      const share = lasts ? Math.min(1, (performance.now() - start) / lasts) : 1, eased = share * share * (3 - 2 * share);
      camera.position.lerpVectors(from, eye, eased);
      controls.target.lerpVectors(target, spot, eased);
      controls.update();
      this.stage.move();
      if (share < 1) requestAnimationFrame(step);
    };
    step();
  }

  private follow(): void {
    const first = this.first;
    if (!first) return;
    this.show_side(first, this.at);
    const z = first.moves.layer_z[this.at.layer]!;
    const share = this.at.step / Math.max(1, steps_of(first.moves, this.at.layer));
    const last = this.at.layer === first.moves.layer_z.length - 1 && share === 1;
    for (const side of this.sides.slice(1)) {
      const layer = last ? side.moves.layer_z.length - 1 : layer_at(side.moves.layer_z, z);
      this.show_side(side, { layer, step: Math.round(share * steps_of(side.moves, layer)), share: 0 });
    }
  }

  private show_side(side: Side, at: Moment): void {
    const from = side === this.first || this.from_layer === 0 ? this.from_layer : layer_at(side.moves.layer_z, this.first!.moves.layer_z[this.from_layer]!);
    side.view.show({ from_layer: Math.min(from, at.layer), layer: at.layer, step: at.step, share: at.share });
  }

  private tick(): void {
    const m = this.first?.moves;
    if (!this.playing || !m) return;
    const now = performance.now();
    const at = later(m, this.at, Math.min(0.25, (now - this.last_tick) / 1000) * this.speed);
    this.last_tick = now;
    this.go(at);
    if (at.layer === m.layer_z.length - 1 && at.step >= steps_of(m, at.layer)) this.play(false);
    else requestAnimationFrame(() => this.tick());
  }

  private paint_background(): void { this.stage.background.set(dark_query.matches ? "#15181d" : "#f6f4f0"); this.stage.ask(); }
  private emit(what: Change): void { for (const l of this.listeners) l(what); }
}
