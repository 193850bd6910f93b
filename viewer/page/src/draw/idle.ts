// What no slicer shows: where every nozzle is, what hangs from it, and the ghost it traces over the layer while another
// one prints. Also the travels of the layer.
import * as THREE from "three";
import { flag, start_of, type Audit, type Moves, type Summary } from "../data/print.ts";
import { carriage_at, move_at, time_at } from "../model/moment.ts";
import { Ooze } from "../model/ooze.ts";
import { css, nozzle_colours } from "../model/palette.ts";
import { flat_material, solid_material, type FlatMaterial } from "./plain_materials.ts";
import type { Look } from "./print_view.ts";

const string_mm_per_mm3 = 5, string_mm = 0.35;

export class Idle {
  readonly group = new THREE.Group();
  readonly ooze: Ooze;
  carried_mm3: number[] = [];
  private readonly tips: THREE.InstancedMesh;
  private readonly strings: THREE.InstancedMesh;
  private readonly drops: THREE.InstancedMesh;
  private readonly ghosts: THREE.LineSegments[] = [];
  private readonly travels: THREE.LineSegments;
  private readonly colours: THREE.Color[];
  private layer = 0;
  private step = 0;
  private share = 0;
  private ghost_layer = -1;
  private look: Look | null = null;

  constructor(private readonly summary: Summary, private readonly moves: Moves) {
    const n = summary.nozzles.length;
    this.ooze = new Ooze(moves, n);
    this.colours = nozzle_colours(summary.nozzles.map((z) => z.colour)).map((c) => new THREE.Color(css(c).replace(/ /g, ",")));
    // Brass-like outline of a nozzle: flat tip, cone, short barrel.
    const outline = [[0, 0], [0.3, 0], [2.6, 3.2], [2.6, 4.6], [3.4, 4.6], [3.4, 7.5], [1.6, 7.5], [1.6, 12], [0, 12]].map(([r, z]) => new THREE.Vector2(r, z));
    const body = new THREE.LatheGeometry(outline, 24).rotateX(Math.PI / 2);
    const string = new THREE.CylinderGeometry(string_mm * 0.5, string_mm * 0.8, 1, 8).rotateX(Math.PI / 2).translate(0, 0, -0.5);
    const drop = new THREE.SphereGeometry(1, 12, 10);
    this.tips = new THREE.InstancedMesh(body, solid_material(0.7, false), n);
    // The string hangs into the print: it is drawn over it, else nobody would see it.
    const wet = solid_material(0.95, true);
    this.strings = new THREE.InstancedMesh(string, wet, n);
    this.drops = new THREE.InstancedMesh(drop, wet, n);
    for (const m of [this.tips, this.strings, this.drops]) {
      m.frustumCulled = false;
      this.colours.forEach((c, i) => m.setColorAt(i, c));
      this.group.add(m);
    }
    this.strings.renderOrder = this.drops.renderOrder = 10;
    for (let i = 0; i < n; i++) {
      const ghost = new THREE.LineSegments(new THREE.BufferGeometry(), flat_material(this.colours[i]!, 0.45));
      const [x, y] = summary.nozzles[i]!.offset_mm;
      ghost.position.set(x, y, 0.05);
      this.ghosts.push(ghost);
      this.group.add(ghost);
    }
    this.travels = new THREE.LineSegments(new THREE.BufferGeometry(), flat_material("#3b5f86", 0.8));
    this.group.add(this.travels);
    for (const l of [...this.ghosts, this.travels]) { l.frustumCulled = false; l.visible = false; }
  }

  set_audit(audit: Audit): void { this.ooze.set_audit(audit); this.place(); }

  set_look(look: Look): void {
    this.look = look;
    (this.travels.material as FlatMaterial).uniforms.colour.value.set(look.dark ? "#8fb3d9" : "#3b5f86");
    for (const m of [this.tips, this.strings, this.drops]) m.visible = look.idle;
    this.lines();
  }

  set_layer(layer: number): void { this.layer = layer; this.lines(); }
  set_step(step: number, share: number): void { this.step = step; this.share = share; this.place(); }

  private place(): void {
    const { moves } = this;
    const at = { layer: this.layer, step: this.step, share: this.share };
    const move = move_at(moves, at), time_s = time_at(moves, at);
    const [x, y, z] = carriage_at(moves, at);
    const m = new THREE.Matrix4();
    this.summary.nozzles.forEach((nozzle, i) => {
      const [dx, dy] = nozzle.offset_mm;
      const carried = this.ooze.carried_mm3(i, move, time_s);
      this.carried_mm3[i] = carried;
      this.tips.setMatrixAt(i, m.makeTranslation(x + dx, y + dy, z));
      const length = carried * string_mm_per_mm3, radius = Math.max(1e-4, Math.cbrt(carried * 0.12));
      this.strings.setMatrixAt(i, m.makeScale(1, 1, Math.max(1e-4, length)).setPosition(x + dx, y + dy, z));
      this.drops.setMatrixAt(i, m.makeScale(radius, radius, radius * 1.3).setPosition(x + dx, y + dy, z - length));
    });
    for (const mesh of [this.tips, this.strings, this.drops]) mesh.instanceMatrix.needsUpdate = true;
    this.travels.geometry.setDrawRange(0, 2 * this.travels_done());
  }

  private travels_done(): number {
    const starts = this.travels.userData["step"] as number[] | undefined;
    if (!starts) return 0;
    let n = starts.length;
    while (n > 0 && starts[n - 1]! >= this.step) n--;
    return n;
  }

  /** Ghosts and travels of the layer; written when they are looked at. */
  private lines(): void {
    const look = this.look;
    if (!look) return;
    for (const g of this.ghosts) g.visible = look.idle && this.summary.idle_nozzle === "same_height";
    this.travels.visible = look.travel;
    if (this.ghost_layer === this.layer || !(look.idle || look.travel)) return;
    this.ghost_layer = this.layer;
    const { moves } = this;
    const { carriage, position, order, layer_start, tool, flags } = moves;
    const ghosts: number[][] = this.ghosts.map(() => []), travel: number[] = [], steps: number[] = [];
    const first = layer_start[this.layer]!, z = moves.layer_z[this.layer]!;
    for (let k = first; k < layer_start[this.layer + 1]!; k++) {
      const i = order[k]!;
      if (i === 0) continue;
      ghosts.forEach((g, n) => { if (tool[i] !== n && tool[i - 1] === tool[i]) g.push(carriage[2 * i - 2]!, carriage[2 * i - 1]!, z, carriage[2 * i]!, carriage[2 * i + 1]!, z); });
      if (!(flags[i]! & flag.lays)) {
        travel.push(...start_of(moves, i), position[3 * i - 1]!, position[3 * i]!, position[3 * i + 1]!, position[3 * i + 2]!);
        steps.push(k - first);
      }
    }
    const write = (lines: THREE.LineSegments, points: number[]) => {
      lines.geometry.dispose();
      lines.geometry = new THREE.BufferGeometry();
      lines.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    };
    this.ghosts.forEach((g, n) => write(g, ghosts[n]!));
    write(this.travels, travel);
    this.travels.userData["step"] = steps;
    this.travels.geometry.setDrawRange(0, 2 * this.travels_done());
  }

  dispose(): void {
    for (const l of [...this.ghosts, this.travels, this.tips, this.strings, this.drops]) {
      l.geometry.dispose();
      (l.material as THREE.Material).dispose();
      if (l instanceof THREE.InstancedMesh) l.dispose();
    }
  }
}
