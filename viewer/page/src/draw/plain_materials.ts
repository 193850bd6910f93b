// The two plain materials beside the roads: flat colour, and a softly lit solid. Our own, because three's general ones
// take a machine that draws in software a second to compile, before the first picture.
import * as THREE from "three";

const flat_vertex = /* glsl */ `void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;
const flat_fragment = /* glsl */ `uniform vec3 colour; uniform float opacity; out vec4 result; void main() { result = vec4(colour, opacity); }`;

export type FlatMaterial = THREE.ShaderMaterial & { uniforms: { colour: { value: THREE.Color }; opacity: { value: number } } };

export function flat_material(colour: THREE.ColorRepresentation, opacity = 1): FlatMaterial {
  return new THREE.ShaderMaterial({
    vertexShader: flat_vertex, fragmentShader: flat_fragment, glslVersion: THREE.GLSL3, side: THREE.DoubleSide, transparent: opacity < 1, depthWrite: opacity >= 1,
    uniforms: { colour: { value: new THREE.Color(colour) }, opacity: { value: opacity } },
  }) as FlatMaterial;
}

const solid_vertex = /* glsl */ `
  out vec3 shade;
  void main() {
    vec4 at = modelViewMatrix * instanceMatrix * vec4(position, 1.0);
    vec3 n = normalize(normalMatrix * mat3(instanceMatrix) * normal);
    shade = instanceColor.rgb * (0.55 + 0.5 * max(0.0, dot(n, normalize(vec3(-0.45, 0.55, 1.0))))) + vec3(0.22 * pow(max(0.0, dot(n, normalize(vec3(-0.3, 0.4, 1.0)))), 16.0));
    gl_Position = projectionMatrix * at;
  }`;
const solid_fragment = /* glsl */ `uniform float opacity; in vec3 shade; out vec4 result; void main() { result = vec4(shade, opacity); }`;

/** For instances with a colour each; `over`: drawn over everything. */
export function solid_material(opacity: number, over: boolean): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({ vertexShader: solid_vertex, fragmentShader: solid_fragment, glslVersion: THREE.GLSL3, transparent: true, depthTest: !over, uniforms: { opacity: { value: opacity } } });
}
