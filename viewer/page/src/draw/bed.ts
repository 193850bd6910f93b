// The bed: its outline, a grid of 10 mm, and where X and Y begin.
import * as THREE from "three";
import type { Summary } from "../data/print.ts";
import { flat_material } from "./plain_materials.ts";

export function bed(summary: Summary, dark: boolean): THREE.Object3D {
  const group = new THREE.Group();
  const outline = summary.bed_mm;
  if (outline.length < 3) return group;
  const shape = new THREE.Shape(outline.map(([x, y]) => new THREE.Vector2(x, y)));
  const plate = new THREE.Mesh(new THREE.ShapeGeometry(shape), plate_material(dark));
  plate.position.z = -0.05;
  const xs = outline.map((p) => p[0]), ys = outline.map((p) => p[1]);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const points: number[] = [];
  for (let x = Math.ceil(x0 / 10) * 10; x <= x1; x += 10) points.push(x, y0, 0, x, y1, 0);
  for (let y = Math.ceil(y0 / 10) * 10; y <= y1; y += 10) points.push(x0, y, 0, x1, y, 0);
  const grid = lines(points, dark ? "#2c323b" : "#d9d5cc");
  const edge: number[] = [];
  outline.forEach(([x, y], i) => { const [u, v] = outline[(i + 1) % outline.length]!; edge.push(x, y, 0, u, v, 0); });
  group.add(plate, grid, lines(edge, dark ? "#4a525e" : "#b5afa3"));
  return group;
}

/** Frees what a bed holds on the graphics card. */
export function dispose_bed(bed: THREE.Object3D): void {
  bed.removeFromParent();
  bed.traverse((o) => { if (o instanceof THREE.Mesh || o instanceof THREE.LineSegments) { o.geometry.dispose(); (o.material as THREE.Material).dispose(); } });
}

function plate_material(dark: boolean): THREE.Material {
  const material = flat_material(dark ? "#20242b" : "#eae7e0");
  material.polygonOffset = true;
  material.polygonOffsetFactor = material.polygonOffsetUnits = 2;
  return material;
}

function lines(points: number[], colour: string): THREE.LineSegments {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  return new THREE.LineSegments(geometry, flat_material(colour));
}
