/**
 * Lines between two points of the world, of a width in pixels and over everything, whole or dashed: all in one draw.
 * Each is an instance of one quad (`thick-lines.ts` draws one list of lines many times; here there are few, and other
 * ones in each picture).
 */
import {
  BufferAttribute,
  DoubleSide,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  ShaderMaterial,
} from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import { LINE_RESOLUTION } from '../thick-lines.ts';
import { grown, type MarkColor } from './pin-marks.ts';

export class PinLines {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private capacity = 0;
  private start = new Float32Array(0);
  private end = new Float32Array(0);
  private look = new Float32Array(0);

  constructor() {
    const geometry = new InstancedBufferGeometry();
    // x: 0 at the start, 1 at the end; y: the side.
    geometry.setAttribute('position', new BufferAttribute(new Float32Array([0, -1, 0, 0, 1, 0, 1, -1, 0, 1, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    geometry.instanceCount = 0;
    this.mesh = new Mesh(geometry, lineMaterial());
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 40;
  }

  clear(): void {
    this.mesh.geometry.instanceCount = 0;
  }

  /** @param widthPx CSS pixels */
  add(start: Vec3, end: Vec3, { r, g, b }: MarkColor, widthPx: number, isDashed: boolean): void {
    const { geometry } = this.mesh;
    const i = geometry.instanceCount;
    if (i === this.capacity) this.grow();
    for (let k = 0; k < 3; k++) {
      this.start[3 * i + k] = start[k];
      this.end[3 * i + k] = end[k];
    }
    this.look.set([r, g, b, isDashed ? -widthPx : widthPx], 4 * i);
    geometry.instanceCount = i + 1;
  }

  filled(): void {
    const { geometry } = this.mesh;
    this.mesh.visible = geometry.instanceCount > 0;
    for (const name of ['start', 'end', 'look']) {
      const attribute = geometry.attributes[name];
      if (attribute) attribute.needsUpdate = true;
    }
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  private grow(): void {
    const { geometry } = this.mesh;
    const count = geometry.instanceCount;
    this.capacity = Math.max(16, 2 * this.capacity);
    this.start = grown(this.start, 3 * this.capacity);
    this.end = grown(this.end, 3 * this.capacity);
    this.look = grown(this.look, 4 * this.capacity);
    geometry.dispose();
    geometry.setAttribute('start', new InstancedBufferAttribute(this.start, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('end', new InstancedBufferAttribute(this.end, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('look', new InstancedBufferAttribute(this.look, 4).setUsage(DynamicDrawUsage));
    geometry.instanceCount = count;
  }
}

function lineMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    side: DoubleSide,
    transparent: true,
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    uniforms: { resolution: LINE_RESOLUTION },
    vertexShader: /* glsl */ `
      attribute vec3 start;
      attribute vec3 end;
      attribute vec4 look;
      uniform vec2 resolution;
      varying float vAlong;
      flat varying vec4 vLook;
      void main() {
        vLook = look;
        vec4 a = projectionMatrix * (modelViewMatrix * vec4(start, 1.0));
        vec4 b = projectionMatrix * (modelViewMatrix * vec4(end, 1.0));
        float da = a.z + a.w;
        float db = b.z + b.w;
        if (da <= 0.0 && db <= 0.0) {
          gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
          return;
        }
        // What lies before the near plane has no direction on screen: cut it off.
        if (da < 0.0) a = mix(a, b, da / (da - db));
        if (db < 0.0) b = mix(b, a, db / (db - da));
        vec2 from = a.xy / a.w * 0.5 * resolution;
        vec2 to = b.xy / b.w * 0.5 * resolution;
        float size = length(to - from);
        vec2 along = size > 1e-4 ? (to - from) / size : vec2(1.0, 0.0);
        vec2 at = mix(from, to, position.x) + vec2(-along.y, along.x) * position.y * 0.5 * abs(look.w);
        // Flat on the screen, so that dashes are of one length all the way.
        vAlong = position.x * size;
        gl_Position = vec4(at / (0.5 * resolution), 0.0, 1.0);
      }
    `,
    fragmentShader: /* glsl */ `
      varying float vAlong;
      flat varying vec4 vLook;
      void main() {
        if (vLook.w < 0.0 && mod(vAlong, 8.0) > 5.0) discard;
        gl_FragColor = vec4(vLook.rgb, 1.0);
      }
    `,
  });
}
