/**
 * Markers of a size in pixels, over everything, told apart by shape: all of them in one draw.
 *
 *     round     a pin that holds a position            square   one that holds the orientation too
 *     ring      where a click would pin                dot      a point that could be pinned
 *     lock      a joint that does not bend             stiff    one that bends unwillingly
 *
 * Quads rather than WebGL points, as in `dots.ts`.
 */
import {
  BufferAttribute,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  ShaderMaterial,
} from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import { LINE_RESOLUTION, rawColor } from '../thick-lines.ts';

const SHAPES = ['round', 'square', 'ring', 'dot', 'lock', 'stiff'] as const;
export type MarkShape = (typeof SHAPES)[number];

/** r g b of 0 to 1, sRGB, as they are put on screen. */
export interface MarkColor {
  readonly r: number;
  readonly g: number;
  readonly b: number;
}

export class PinMarks {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private capacity = 0;
  private at = new Float32Array(0);
  private look = new Float32Array(0);
  private color = new Float32Array(0);

  constructor() {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute(
      'position',
      new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0]), 3),
    );
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    geometry.instanceCount = 0;
    this.mesh = new Mesh(geometry, markMaterial());
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 41;
  }

  setHalo(css: string): void {
    this.mesh.material.uniforms.halo.value.copy(rawColor(css));
  }

  clear(): void {
    this.mesh.geometry.instanceCount = 0;
  }

  /**
   * @param at in the world
   * @param sizePx CSS pixels across, without the thin halo
   * @param fill 0 to 1: how much of its inside has its colour
   */
  add(at: Vec3, shape: MarkShape, color: MarkColor, opacity: number, sizePx: number, fill: number): void {
    const { geometry } = this.mesh;
    const i = geometry.instanceCount;
    if (i === this.capacity) this.grow();
    for (let k = 0; k < 3; k++) this.at[3 * i + k] = at[k];
    this.look[3 * i] = SHAPES.indexOf(shape);
    this.look[3 * i + 1] = sizePx;
    this.look[3 * i + 2] = fill;
    this.color[4 * i] = color.r;
    this.color[4 * i + 1] = color.g;
    this.color[4 * i + 2] = color.b;
    this.color[4 * i + 3] = opacity;
    geometry.instanceCount = i + 1;
  }

  filled(): void {
    const { geometry } = this.mesh;
    this.mesh.visible = geometry.instanceCount > 0;
    for (const name of ['at', 'look', 'markColor']) {
      const attribute = geometry.attributes[name];
      if (attribute) attribute.needsUpdate = true;
    }
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  /** Twice the room. A buffer of another size is another buffer: the old ones are let go. */
  private grow(): void {
    const { geometry } = this.mesh;
    const count = geometry.instanceCount;
    this.capacity = Math.max(16, 2 * this.capacity);
    this.at = grown(this.at, 3 * this.capacity);
    this.look = grown(this.look, 3 * this.capacity);
    this.color = grown(this.color, 4 * this.capacity);
    geometry.dispose();
    geometry.setAttribute('at', new InstancedBufferAttribute(this.at, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('look', new InstancedBufferAttribute(this.look, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('markColor', new InstancedBufferAttribute(this.color, 4).setUsage(DynamicDrawUsage));
    geometry.instanceCount = count;
  }
}

/** The same numbers with more room behind them. */
export function grown(from: Float32Array, size: number): Float32Array<ArrayBuffer> {
  const to = new Float32Array(size);
  to.set(from);
  return to;
}

function markMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    transparent: true,
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    uniforms: { resolution: LINE_RESOLUTION, halo: { value: rawColor('#000000') } },
    vertexShader: /* glsl */ `
      attribute vec3 at;
      attribute vec3 look;
      attribute vec4 markColor;
      uniform vec2 resolution;
      varying vec2 vAt;
      flat varying vec3 vLook;
      flat varying vec4 vColor;
      void main() {
        vLook = look;
        vColor = markColor;
        vAt = position.xy * (0.5 * look.y + 2.5);
        vec4 p = projectionMatrix * (modelViewMatrix * vec4(at, 1.0));
        p.xy += vAt * 2.0 / resolution * p.w;
        gl_Position = p;
      }
    `,
    fragmentShader: /* glsl */ `
      uniform vec3 halo;
      varying vec2 vAt;
      flat varying vec3 vLook;
      flat varying vec4 vColor;

      float box(vec2 p, vec2 half_) {
        vec2 q = abs(p) - half_;
        return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0);
      }
      float disc(vec2 p, float r) { return length(p) - r; }
      float ring(vec2 p, float r, float width) { return abs(length(p) - r + 0.5 * width) - 0.5 * width; }

      // How far it is from the edge of the shape, pixels, below 0 inside: of all of it, and of what has its colour.
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
        gl_FragColor = vec4(mix(halo, vColor.rgb, core), vColor.a * shown * mix(0.75, 1.0, core));
      }
    `,
  });
}
