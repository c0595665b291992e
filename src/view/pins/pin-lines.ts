/**
 * Lines between two world points, with a width in pixels, over everything, solid or dashed: all in one draw, each an
 * instance of one quad. (`thick-lines.ts` draws one list of lines many times; here there are few, and others every
 * frame.)
 */
import { DoubleSide, type Mesh, ShaderMaterial } from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import { LINE_RESOLUTION } from '../scene/thick-lines.ts';
import { InstancedQuads } from './instanced-quads.ts';
import type { MarkColor } from './pin-marks.ts';

/** x: 0 at the start, 1 at the end; y: the side. */
const CORNERS = [0, -1, 0, 1, 1, -1, 1, 1];

export class PinLines {
  private readonly quads = new InstancedQuads(CORNERS, { start: 3, end: 3, look: 4 }, lineMaterial(), 40);

  get mesh(): Mesh {
    return this.quads.mesh;
  }

  clear(): void {
    this.quads.clear();
  }

  /** @param widthPx CSS pixels */
  add(from: Vec3, to: Vec3, { r, g, b }: MarkColor, widthPx: number, isDashed: boolean): void {
    const { quads } = this;
    const i = quads.add();
    const { start, end, look } = quads.numbers;
    for (let k = 0; k < 3; k++) {
      start[3 * i + k] = from[k];
      end[3 * i + k] = to[k];
    }
    look[4 * i] = r;
    look[4 * i + 1] = g;
    look[4 * i + 2] = b;
    look[4 * i + 3] = isDashed ? -widthPx : widthPx;
  }

  filled(): void {
    this.quads.filled();
  }

  dispose(): void {
    this.quads.dispose();
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
        // Points in front of the near plane have no position on screen: clip.
        if (da < 0.0) a = mix(a, b, da / (da - db));
        if (db < 0.0) b = mix(b, a, db / (db - da));
        vec2 from = a.xy / a.w * 0.5 * resolution;
        vec2 to = b.xy / b.w * 0.5 * resolution;
        float size = length(to - from);
        vec2 along = size > 1e-4 ? (to - from) / size : vec2(1.0, 0.0);
        vec2 at = mix(from, to, position.x) + vec2(-along.y, along.x) * position.y * 0.5 * abs(look.w);
        // Flat on screen, so that dashes are equally long.
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
