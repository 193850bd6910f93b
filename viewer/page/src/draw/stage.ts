// The stage: canvas, camera, and when to draw. Nothing is drawn unless asked for; no frame begins before the graphics
// card has finished the one before; while something moves the picture may be coarse, then it is drawn once in full.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Budget } from "./budget.ts";
import { flat_material, solid_material } from "./plain_materials.ts";
import { road_material, RoadChunk } from "./roads_mesh.ts";

export interface View {
  scene: THREE.Scene;
  /** Chooses the level of detail before a frame; returns how many roads it draws. */
  prepare(pixels_per_mm: number, budget_roads: number): number;
}

export interface Counters { frames: number; draw_calls: number; triangles: number; roads: number; script_ms: number; script_ms_worst: number; gpu_ms: number; settled_at_ms: number; software: boolean }

const moving_ms = 40, still_ms = 230; // time for the roads of a frame while something moves, and after
const rest_ms = 90; // so long after the last movement the full picture is drawn

export class Stage {
  readonly renderer: THREE.WebGLRenderer;
  readonly camera = new THREE.PerspectiveCamera(32, 1, 1, 5000);
  readonly controls: OrbitControls;
  readonly counters: Counters;
  views: View[] = [];
  background = new THREE.Color("#f4f2ee");
  /** Resolves when the shaders are compiled: a frame before that would make the page wait for them. */
  readonly ready: Promise<unknown>;
  private readonly budget: Budget;
  private readonly uploads = new THREE.Scene();
  private readonly nowhere = new THREE.WebGLRenderTarget(1, 1);
  private scheduled = false;
  private busy = false;
  private moved_at = -1e9;
  private wants_frame = false;
  private full_drawn = false;
  private rest_timer = 0;
  private waiting: (() => void)[] = [];
  private next_frame: (() => void)[] = [];

  constructor(readonly canvas: HTMLCanvasElement) {
    const software = draws_in_software();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !software, powerPreference: "high-performance" });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours are given as they shall appear
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    THREE.ColorManagement.enabled = false;
    this.budget = new Budget(software);
    this.counters = { frames: 0, draw_calls: 0, triangles: 0, roads: 0, script_ms: 0, script_ms_worst: 0, gpu_ms: 0, settled_at_ms: 0, software };
    this.renderer.debug.checkShaderErrors = false; // asking would wait for the compiler
    this.camera.up.set(0, 0, 1);
    this.ready = this.compile_early();
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.move());
    this.controls.zoomToCursor = true;
    new ResizeObserver(() => this.ask()).observe(canvas);
  }

  /** Has the shaders compiled while the data are on their way. */
  private compile_early(): Promise<unknown> {
    const scene = new THREE.Scene();
    const roads = new RoadChunk(new Uint32Array(8), new Uint32Array(1), () => 0, road_material());
    const tip = new THREE.InstancedMesh(new THREE.SphereGeometry(), solid_material(0.7, false), 1);
    tip.setColorAt(0, new THREE.Color());
    scene.add(roads.mesh, tip, new THREE.Mesh(new THREE.PlaneGeometry(), flat_material("#000")), new THREE.Sprite());
    roads.mesh.visible = true;
    return this.renderer.compileAsync(scene, this.camera);
  }

  /** Something moves: draw soon, coarse if need be, and in full when it rests. */
  move(): void { this.moved_at = performance.now(); this.ask(); }

  /** Draw once more. */
  ask(): void {
    this.wants_frame = true;
    this.full_drawn = false;
    if (!this.scheduled && !this.busy) { this.scheduled = true; requestAnimationFrame(() => this.frame()); }
  }

  /** Resolves when the picture asked for is drawn in full. */
  settled(): Promise<void> {
    return !this.wants_frame && this.full_drawn && !this.busy ? Promise.resolve() : new Promise((r) => this.waiting.push(r));
  }

  /** Writes an object's buffers to the graphics card without drawing it, in a frame of its own. */
  async upload(object: THREE.Object3D): Promise<void> {
    await new Promise((r) => requestAnimationFrame(r));
    const visible = object.visible;
    object.visible = true;
    this.uploads.add(object);
    this.renderer.setRenderTarget(this.nowhere);
    this.renderer.render(this.uploads, this.camera);
    this.renderer.setRenderTarget(null);
    this.uploads.remove(object);
    object.visible = visible;
  }

  /** Resolves when the frame being drawn, or the next, is on the screen. */
  frame_done(): Promise<void> { return new Promise((r) => this.next_frame.push(r)); }

  /** Whether two prints stand one above the other, as on a phone. */
  tall(): boolean { return this.views.length > 1 && this.canvas.clientHeight > this.canvas.clientWidth * 1.1; }

  pixels_per_mm(): number {
    const distance = this.camera.position.distanceTo(this.controls.target);
    return this.canvas.height / (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360));
  }

  private frame(): void {
    this.scheduled = false;
    const start = performance.now();
    const moving = start - this.moved_at < rest_ms;
    this.wants_frame = false;
    this.resize();
    const { renderer, camera, canvas } = this;
    renderer.info.reset();
    renderer.setScissorTest(true);
    const n = Math.max(1, this.views.length);
    const width = canvas.clientWidth, height = canvas.clientHeight;
    const tall = this.tall();
    camera.aspect = tall ? width / (height / n) : width / n / height;
    camera.updateProjectionMatrix();
    let roads = 0;
    const budget = this.budget.roads_in(moving ? moving_ms : still_ms) / n;
    this.views.forEach((view, k) => {
      roads += view.prepare(this.pixels_per_mm(), budget);
      const [x, y, w, h] = tall ? [0, (height / n) * (n - 1 - k), width, height / n] : [(width / n) * k, 0, width / n, height];
      renderer.setViewport(x, y, w, h);
      renderer.setScissor(x, y, w, h);
      renderer.setClearColor(this.background);
      renderer.clear();
      renderer.render(view.scene, camera);
    });
    const c = this.counters;
    c.frames++;
    c.draw_calls = renderer.info.render.calls;
    c.triangles = renderer.info.render.triangles;
    c.roads = roads;
    c.script_ms = performance.now() - start;
    c.script_ms_worst = Math.max(c.script_ms_worst, c.script_ms);
    performance.measure("cleancolor frame", { start, end: start + c.script_ms });
    this.busy = true;
    void this.drawn(start, roads, !moving);
  }

  private async drawn(start: number, roads: number, full: boolean): Promise<void> {
    await gpu_done(this.renderer.getContext() as WebGL2RenderingContext);
    this.busy = false;
    this.next_frame.splice(0).forEach((r) => r());
    this.counters.gpu_ms = performance.now() - start;
    this.budget.learn(roads, this.counters.gpu_ms);
    clearTimeout(this.rest_timer);
    if (this.wants_frame) this.ask();
    else if (!full) this.rest_timer = window.setTimeout(() => this.ask(), Math.max(0, this.moved_at + rest_ms - performance.now()));
    else {
      this.full_drawn = true;
      this.counters.settled_at_ms = performance.now();
      this.waiting.splice(0).forEach((r) => r());
    }
  }

  private resize(): void {
    const { canvas, renderer } = this;
    const ratio = this.counters.software ? 1 : Math.min(2, window.devicePixelRatio);
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width !== Math.floor(width * ratio) || canvas.height !== Math.floor(height * ratio)) {
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height, false);
    }
  }
}

async function gpu_done(gl: WebGL2RenderingContext): Promise<void> {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!fence) return;
  gl.flush();
  for (;;) {
    await new Promise((r) => setTimeout(r, 4));
    const state = gl.clientWaitSync(fence, 0, 0);
    if (state !== gl.TIMEOUT_EXPIRED) break;
  }
  gl.deleteSync(fence);
}

function draws_in_software(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(gl!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
