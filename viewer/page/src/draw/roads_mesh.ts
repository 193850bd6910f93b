// Draws pieces of road: six corners each, the visible side of a prism with the section of a diamond. Which side that is,
// the vertex shader decides, so that no corner is spent on what looks away. The shader reads the roads from a texture by
// the number of the vertex: one copy of 32 bytes a road, and no instances, of which drawing in software is slow.
import * as THREE from "three";
import type { Palette } from "../model/colouring.ts";
import { words_per_road, type Roads } from "../model/roads.ts";

const vertex = /* glsl */ `
  uniform highp usampler2D roads; uniform highp usampler2D keys; uniform lowp sampler2D palette; uniform int column; uniform int row;
  uniform float cut_below_z; uniform vec2 middle; uniform float rampart; uniform float grow; uniform float detail;
  out vec3 shade;
  void main() {
    int road = gl_VertexID / 6, corner = gl_VertexID - 6 * road;
    ivec2 texel = ivec2(2 * (road & 511), road >> 9);
    uvec4 first = texelFetch(roads, texel, 0), second = texelFetch(roads, texel + ivec2(1, 0), 0);
    vec3 a = uintBitsToFloat(first.xyz), b = uintBitsToFloat(second.xyz);
    vec2 size = vec2(float(first.w & 255u), float(first.w >> 8u));
    bool auxiliary = second.w != 0u, at_start = corner < 3;
    float across = float(corner - (at_start ? 1 : 4));  // -1 flank, 0 ridge, 1 flank
    vec3 d = b - a;
    float along = length(d);
    d = along > 1e-5 ? d / along : vec3(1.0, 0.0, 0.0);
    float w = size.x * 0.0053 + grow, h = size.y * 0.0062 + grow; // a little more than half, so that neighbours close up
    vec3 side = normalize(vec3(-d.y, d.x, 0.0) + vec3(0.0, 1e-6, 0.0)), up = cross(d, side);
    w *= mix(1.6, 1.0, detail); h *= mix(1.3, 1.0, detail);
    vec3 centre = 0.5 * (a + b) - vec3(0.0, 0.0, size.y * 0.005);
    vec3 eye = isOrthographic ? vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]) : normalize(cameraPosition - centre);
    // The diamond's two faces towards the eye share one corner, the ridge; the other two are beside it.
    float es = dot(eye, side), eu = dot(eye, up);
    bool flat_on = abs(eu) * w > abs(es) * h;
    vec3 ridge = flat_on ? up * sign(eu) : side * sign(es), flank = flat_on ? side * sign(eu) : -up * sign(es);
    float rw = flat_on ? h : w, fw = flat_on ? w : h;
    // Near, a road is round; from afar, where it is a pixel or two, that would only flicker: there it has the normal of
    // both faces together, each by how much of it is seen.
    vec3 round_normal = across == 0.0 ? ridge : normalize(flank * across + ridge * 0.25);
    vec3 normal = normalize(mix(normalize(side * es * h + up * eu * w), round_normal, detail));
    vec3 p = (at_start ? a - d * w * 0.7 : b + d * w * 0.7) - vec3(0.0, 0.0, size.y * 0.005);
    p += across == 0.0 ? ridge * rw : flank * across * fw;
    // Light from the eye's upper left, and from the sky.
    vec3 right = vec3(viewMatrix[0][0], viewMatrix[1][0], viewMatrix[2][0]), top = vec3(viewMatrix[0][1], viewMatrix[1][1], viewMatrix[2][1]);
    vec3 sun = normalize(eye + 0.55 * top - 0.45 * right);
    float light = 0.42 + 0.46 * max(0.0, dot(normal, sun)) + 0.14 * normal.z;
    uint key = texelFetch(keys, ivec2(road & 511, road >> 9), 0).r;
    shade = texelFetch(palette, ivec2((key >> column) & 255u, row < 0 ? 0u : (key >> row) & 255u), 0).rgb * light;
    gl_Position = projectionMatrix * viewMatrix * vec4(p, 1.0);
    // The near half of the rampart opens like a doll's house; what lies below the lowest layer shown is gone.
    bool near_half = dot(centre.xy - middle, eye.xy) > 0.0 && length(eye.xy) > 0.25;
    if (b.z < cut_below_z || (auxiliary && (rampart < 0.5 || (rampart < 1.5 && near_half)))) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }`;
const fragment = /* glsl */ `
  in vec3 shade; out vec4 colour_out;
  void main() { colour_out = vec4(shade, 1.0); }`;

export type RoadMaterial = THREE.ShaderMaterial & { uniforms: Record<"cut_below_z" | "middle" | "rampart" | "grow" | "detail" | "palette" | "column" | "row", THREE.IUniform> };

export function road_material(): RoadMaterial {
  const uniforms = { cut_below_z: { value: -1e9 }, middle: { value: new THREE.Vector2() }, rampart: { value: 1 }, grow: { value: 0 }, detail: { value: 1 }, palette: { value: null }, column: { value: 0 }, row: { value: -1 } };
  return new THREE.ShaderMaterial({ vertexShader: vertex, fragmentShader: fragment, uniforms, glslVersion: THREE.GLSL3, side: THREE.DoubleSide }) as RoadMaterial;
}

/** Has all roads of a material take their colours from this palette. */
export function set_palette(material: RoadMaterial, { colours, column, row }: Palette): void {
  const { uniforms } = material;
  dispose_palette(material);
  const texture = new THREE.DataTexture(new Uint8Array(colours.buffer, colours.byteOffset, colours.byteLength), 256, colours.length / 256, THREE.RGBAFormat, THREE.UnsignedByteType);
  texture.needsUpdate = true;
  uniforms.palette.value = texture;
  uniforms.column.value = 8 * column;
  uniforms.row.value = row === null ? -1 : 8 * row;
}
export function dispose_palette(material: RoadMaterial): void { (material.uniforms.palette.value as THREE.Texture | null)?.dispose(); }

const texture_roads = 512; // roads in a row of the textures
export const chunk_roads = 1 << 17; // roads drawn at once; 2 million moves make no more than 16 draw calls
export const triangles_per_road = 4;

const faces = [0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4];
let shared_index: THREE.BufferAttribute | null = null;
function index(): THREE.BufferAttribute {
  if (!shared_index) {
    const all = new Uint32Array(faces.length * chunk_roads);
    for (let r = 0, k = 0; r < chunk_roads; r++) for (let f = 0; f < 12; f++) all[k++] = 6 * r + faces[f]!;
    shared_index = new THREE.BufferAttribute(all, 1);
  }
  return shared_index;
}

/** A fixed number of roads, at most chunk_roads; `show` draws the first so many. */
export class RoadChunk {
  readonly mesh: THREE.Mesh<THREE.BufferGeometry, RoadMaterial>;
  shown = 0;
  private readonly keys: Uint32Array; // of each road
  private readonly key_texture: THREE.DataTexture;
  private readonly road_texture: THREE.DataTexture;

  /** `move` tells what each road is of, `key_of` the key of that (model/colouring.ts). */
  constructor(words: Uint32Array, readonly move: Uint32Array, key_of: (move: number) => number, material: RoadMaterial) {
    if (move.length > chunk_roads) throw new Error(`${move.length} roads do not fit into a chunk`); // three would leave the rest out
    const rows = Math.max(1, Math.ceil(move.length / texture_roads));
    const padded = new Uint32Array(words_per_road * texture_roads * rows);
    padded.set(words);
    this.road_texture = new THREE.DataTexture(padded, 2 * texture_roads, rows, THREE.RGBAIntegerFormat, THREE.UnsignedIntType);
    this.road_texture.internalFormat = "RGBA32UI";
    this.keys = new Uint32Array(texture_roads * rows);
    this.key_texture = new THREE.DataTexture(this.keys, texture_roads, rows, THREE.RedIntegerFormat, THREE.UnsignedIntType);
    this.key_texture.internalFormat = "R32UI";
    this.set_keys(key_of);
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(index());
    const own = material.clone() as RoadMaterial;
    own.uniforms = { ...material.uniforms, roads: { value: this.road_texture }, keys: { value: this.key_texture } } as RoadMaterial["uniforms"];
    this.mesh = new THREE.Mesh(geometry, own);
    this.mesh.frustumCulled = false;
    this.mesh.matrixAutoUpdate = false;
    this.mesh.visible = false;
    this.road_texture.needsUpdate = true;
  }

  show(count: number): void {
    this.shown = count;
    this.mesh.geometry.setDrawRange(0, faces.length * count);
    this.mesh.visible = count > 0;
  }

  set_keys(key_of: (move: number) => number): void {
    const { keys, move } = this;
    for (let k = 0; k < move.length; k++) keys[k] = key_of(move[k]!);
    this.key_texture.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.geometry.setIndex(null); // others use it on
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.road_texture.dispose();
    this.key_texture.dispose();
  }
}

/** Roads, however many, in as many chunks as they need; `show` draws the first so many. */
export class RoadSet {
  readonly group = new THREE.Group();
  readonly move: Uint32Array; // what each road is of
  private readonly words: Uint32Array;
  private readonly chunks: RoadChunk[] = [];
  private wanted = 0;

  constructor({ words, move, count }: Pick<Roads, "words" | "move" | "count">, private readonly material: RoadMaterial) {
    this.words = words;
    this.move = move.subarray(0, count);
    this.group.matrixAutoUpdate = false;
  }

  /** Makes the chunks, one at each step, and shows each when the step after it is taken. */
  *build(key_of: (move: number) => number): Generator<RoadChunk, void> {
    for (let first = 0; first < this.move.length; first += chunk_roads) {
      const move = this.move.subarray(first, first + chunk_roads);
      const chunk = new RoadChunk(this.words.subarray(words_per_road * first, words_per_road * (first + move.length)), move, key_of, this.material);
      this.chunks.push(chunk);
      yield chunk;
      this.group.add(chunk.mesh);
      this.show(this.wanted);
    }
  }

  /** All chunks at once. */
  static of(roads: Pick<Roads, "words" | "move" | "count">, key_of: (move: number) => number, material: RoadMaterial): RoadSet {
    const made = new RoadSet(roads, material);
    for (const _ of made.build(key_of));
    return made;
  }

  show(count: number): void {
    this.wanted = count;
    this.chunks.forEach((c, k) => c.show(Math.max(0, Math.min(c.move.length, count - k * chunk_roads))));
  }

  /** Roads drawn. */
  get shown(): number { return this.chunks.reduce((sum, c) => sum + c.shown, 0); }

  /** Gives roads new keys, a chunk at each step. */
  *new_keys(key_of: (move: number) => number): Generator<void, void> { for (const c of this.chunks) { c.set_keys(key_of); yield; } }

  dispose(): void {
    this.group.removeFromParent();
    this.chunks.forEach((c) => c.dispose());
  }
}
