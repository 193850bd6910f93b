// The marker of a place: a ring of the same size at any distance, over everything.
import * as THREE from "three";

export class Marker {
  readonly object: THREE.Sprite;

  constructor() {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 128;
    const c = canvas.getContext("2d")!;
    for (const [width, colour] of [[16, "#ffffff"], [8, "#d6246e"]] as const) {
      c.lineWidth = width;
      c.strokeStyle = colour;
      c.beginPath();
      c.arc(64, 64, 50, 0, 2 * Math.PI);
      c.stroke();
    }
    const material = new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas), depthTest: false, sizeAttenuation: false, transparent: true });
    this.object = new THREE.Sprite(material);
    this.object.scale.setScalar(0.035);
    this.object.renderOrder = 20;
  }

  place(at: THREE.Vector3): void { this.object.position.copy(at); }
}
