/**
 * Round markers of a size in pixels, filled or hollow, one per instance, with a thin outline so that they are visible
 * on any background. Quads rather than WebGL points, whose maximum size differs between GPUs.
 */
import { BufferAttribute, BufferGeometry, InstancedMesh, ShaderMaterial } from 'three';
import { LINE_RESOLUTION, rawColor } from './thick-lines.ts';

export interface DotOptions {
  /** Diameter in CSS pixels, outline included. */
  readonly size: number;
  readonly depthTest: boolean;
  /** A circle around what it marks rather than a dot. */
  readonly hollow?: boolean;
  /** A square on its corner rather than a circle. */
  readonly diamond?: boolean;
}

/** Position and visibility come from the instance matrices: translation, and any scale other than 0. */
export function dots(capacity: number, options: DotOptions): InstancedMesh<BufferGeometry, ShaderMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0]), 3));
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  const mesh = new InstancedMesh(geometry, dotMaterial(options), capacity);
  mesh.frustumCulled = false;
  mesh.count = 0;
  return mesh;
}

function dotMaterial({ size, depthTest, hollow = false, diamond = false }: DotOptions): ShaderMaterial {
  return new ShaderMaterial({
    transparent: true,
    depthTest,
    depthWrite: false,
    toneMapped: false,
    uniforms: {
      resolution: LINE_RESOLUTION,
      size: { value: size },
      hollow: { value: hollow ? 1 : 0 },
      diamond: { value: diamond ? 1 : 0 },
      color: { value: rawColor('#ffffff') },
      ring: { value: rawColor('#000000') },
    },
    vertexShader: /* glsl */ `
      uniform vec2 resolution;
      uniform float size;
      varying vec2 vAt;
      void main() {
        vAt = position.xy * (0.5 * size + 1.0);
        vec4 p = projectionMatrix * (modelViewMatrix * instanceMatrix[3]);
        p.xy += vAt * 2.0 / resolution * p.w;
        gl_Position = p;
      }
    `,
    fragmentShader: /* glsl */ `
      uniform float size;
      uniform float hollow;
      uniform float diamond;
      uniform vec3 color;
      uniform vec3 ring;
      varying vec2 vAt;
      void main() {
        float r = mix(length(vAt), abs(vAt.x) + abs(vAt.y), diamond);
        float soft = fwidth(r);
        float inside = 1.0 - smoothstep(-soft, soft, r - 0.5 * size + 0.5);
        float core = 1.0 - smoothstep(-soft, soft, r - 0.5 * size + 2.0);
        // Hollow: a 3 pixel band of colour, outlined on both sides.
        core *= mix(1.0, smoothstep(-soft, soft, r - 0.5 * size + 5.0), hollow);
        inside *= mix(1.0, smoothstep(-soft, soft, r - 0.5 * size + 6.0), hollow);
        gl_FragColor = vec4(mix(ring, color, core), inside * mix(0.7, 1.0, core));
      }
    `,
  });
}
