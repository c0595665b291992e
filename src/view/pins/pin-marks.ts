/**
 * Markers with a size in pixels, over everything, distinguished by shape, all in one draw.
 *
 *     round     a pin that holds a position            square   one that holds the orientation too
 *     ring      where a click would pin                dot      a point that could be pinned
 *     lock      a joint that does not bend             stiff    one with stiffness
 *
 * Covered marks are faint: all are drawn faintly over everything, and again where nothing is in front of them. A joint
 * is inside its limb, so marks are moved towards the viewer by about a limb's radius.
 *
 * Quads rather than WebGL points, as in `dots.ts`.
 */
import { Group, type InstancedBufferGeometry, Mesh, ShaderMaterial } from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import { LINE_RESOLUTION, rawColor } from '../scene/thick-lines.ts';
import { InstancedQuads } from './instanced-quads.ts';

const SHAPES = ['round', 'square', 'ring', 'dot', 'lock', 'stiff'] as const;
export type MarkShape = (typeof SHAPES)[number];

/** sRGB, 0 to 1. */
export interface MarkColor {
  readonly r: number;
  readonly g: number;
  readonly b: number;
}

const CORNERS = [-1, -1, 1, -1, -1, 1, 1, 1];

/** Opacity factor of covered marks. */
const COVERED = 0.35;

export class PinMarks {
  readonly object = new Group();
  private readonly quads = new InstancedQuads(CORNERS, { at: 3, look: 4, markColor: 4 }, markMaterial(false), 41);
  private readonly uncovered: Mesh<InstancedBufferGeometry, ShaderMaterial>;

  constructor() {
    const { geometry } = this.quads.mesh;
    this.uncovered = new Mesh(geometry, markMaterial(true));
    this.uncovered.frustumCulled = false;
    this.uncovered.renderOrder = 42;
    this.object.add(this.quads.mesh, this.uncovered);
  }

  setHalo(css: string): void {
    for (const { material } of [this.quads.mesh, this.uncovered]) material.uniforms.halo.value.copy(rawColor(css));
  }

  clear(): void {
    this.quads.clear();
  }

  /**
   * @param at in the world
   * @param sizePx diameter in CSS pixels, without the thin halo
   * @param fill 0 to 1: how much of its inside is coloured
   * @param cover surfaces up to this far in front don't cover it, in world units; Infinity: nothing covers it
   */
  add(
    at: Vec3,
    shape: MarkShape,
    color: MarkColor,
    opacity: number,
    sizePx: number,
    fill: number,
    cover: number,
  ): void {
    const { quads } = this;
    const i = quads.add();
    const { at: places, look, markColor } = quads.numbers;
    for (let k = 0; k < 3; k++) places[3 * i + k] = at[k];
    look[4 * i] = SHAPES.indexOf(shape);
    look[4 * i + 1] = sizePx;
    look[4 * i + 2] = fill;
    look[4 * i + 3] = cover < Infinity ? cover : -1;
    markColor[4 * i] = color.r;
    markColor[4 * i + 1] = color.g;
    markColor[4 * i + 2] = color.b;
    markColor[4 * i + 3] = opacity;
  }

  filled(): void {
    this.quads.filled();
    this.uncovered.visible = this.quads.mesh.visible;
  }

  dispose(): void {
    this.quads.dispose();
    this.uncovered.material.dispose();
  }
}

/** @param uncovered draws only what nothing covers; else everything, faintly */
function markMaterial(uncovered: boolean): ShaderMaterial {
  return new ShaderMaterial({
    transparent: true,
    depthTest: uncovered,
    depthWrite: false,
    toneMapped: false,
    uniforms: {
      resolution: LINE_RESOLUTION,
      halo: { value: rawColor('#000000') },
      part: { value: uncovered ? 1 : COVERED },
    },
    vertexShader: /* glsl */ `
      attribute vec3 at;
      attribute vec4 look;
      attribute vec4 markColor;
      uniform vec2 resolution;
      varying vec2 vAt;
      flat varying vec3 vLook;
      flat varying vec4 vColor;
      void main() {
        vLook = look.xyz;
        vColor = markColor;
        vAt = position.xy * (0.5 * look.y + 2.5);
        vec4 seen = modelViewMatrix * vec4(at, 1.0);
        vec4 p = projectionMatrix * seen;
        // Keeps its screen position, with the depth of a nearer point.
        vec4 nearer = projectionMatrix * (seen + vec4(0.0, 0.0, look.w, 0.0));
        bool isBefore = look.w < 0.0 || nearer.w <= 0.0;
        p.z = isBefore ? -0.9999 * p.w : max(nearer.z / nearer.w, -0.9999) * p.w;
        p.xy += vAt * 2.0 / resolution * p.w;
        gl_Position = p;
      }
    `,
    fragmentShader: /* glsl */ `
      uniform vec3 halo;
      uniform float part;
      varying vec2 vAt;
      flat varying vec3 vLook;
      flat varying vec4 vColor;

      float box(vec2 p, vec2 half_) {
        vec2 q = abs(p) - half_;
        return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0);
      }
      float disc(vec2 p, float r) { return length(p) - r; }
      float ring(vec2 p, float r, float width) { return abs(length(p) - r + 0.5 * width) - 0.5 * width; }

      // Signed distance to the edge in pixels, negative inside: of the whole shape, and of its coloured part.
      void main() {
        int shape = int(vLook.x + 0.5);
        float r = 0.5 * vLook.y;
        float all;
        float inner;
        if (shape == 0 || shape == 1) {
          all = shape == 0 ? disc(vAt, r) : box(vAt, vec2(r - 0.5));
          float rim = abs(all + 1.0) - 1.0;
          float core = (r - 3.0) * sqrt(vLook.z);
          float mid = vLook.z <= 0.0 ? 1.0 : shape == 0 ? disc(vAt, core) : box(vAt, vec2(core - 0.3));
          inner = min(rim, vLook.z >= 0.99 ? all : mid);
        } else if (shape == 2) {
          inner = ring(vAt, r, 2.0);
          all = inner;
        } else if (shape == 3) {
          inner = disc(vAt, r);
          all = inner;
        } else if (shape == 4) {
          float body = box(vAt + vec2(0.0, 0.22 * r), vec2(0.72 * r, 0.55 * r));
          float bow = max(ring(vAt - vec2(0.0, 0.3 * r), 0.6 * r, 1.6), 0.2 * r - vAt.y);
          inner = min(body, bow);
          all = inner;
        } else {
          vec2 turned = vec2(vAt.x + vAt.y, vAt.x - vAt.y) * 0.70710678;
          inner = abs(box(turned, vec2(0.66 * r)) + 1.0) - 1.0;
          all = inner;
        }
        float soft = 0.6;
        float shown = 1.0 - smoothstep(-soft, soft, all - 1.2);
        float core = 1.0 - smoothstep(-soft, soft, inner);
        gl_FragColor = vec4(mix(halo, vColor.rgb, core), part * vColor.a * shown * mix(0.75, 1.0, core));
      }
    `,
  });
}
