/**
 * Lines with a width in pixels. WebGL lines are one pixel wide, so each segment is a quad, expanded on screen by its
 * vertex shader:
 *
 *        corner (0,1) ┌───────────┐ (1,1)
 *               start ·           · end      ends reach half a width further, so that corners meet and
 *              (0,−1) └───────────┘ (1,−1)   a segment without length is still a dot
 *
 * A whole list of segments is one geometry, drawn once per instance. (three.js's LineSegments2 uses instances for
 * segments, which leaves none for "this box, a thousand times".)
 */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  ShaderMaterial,
  type ShaderMaterialParameters,
  Vector2,
} from 'three';

/** Shared by all line materials and updated by the stage: size of the drawing buffer in CSS pixels. */
export const LINE_RESOLUTION = { value: new Vector2(1, 1) };

/**
 * @param points x y z of start and end, 6 numbers per segment
 * @param colors r g b per segment, 0–1, instead of one colour for all
 */
export function segmentsGeometry(points: ArrayLike<number>, colors?: ArrayLike<number>): BufferGeometry {
  const count = points.length / 6;
  const geometry = new BufferGeometry();
  const start = new Float32Array(count * 12);
  const end = new Float32Array(count * 12);
  const corner = new Float32Array(count * 8);
  const color = colors && new Float32Array(count * 12);
  const index = new Uint32Array(count * 6);
  for (let s = 0; s < count; s++) {
    for (let v = 0; v < 4; v++) {
      for (let k = 0; k < 3; k++) {
        start[12 * s + 3 * v + k] = points[6 * s + k];
        end[12 * s + 3 * v + k] = points[6 * s + 3 + k];
        if (color && colors) color[12 * s + 3 * v + k] = colors[3 * s + k];
      }
      corner[8 * s + 2 * v] = v >> 1;
      corner[8 * s + 2 * v + 1] = v & 1 ? 1 : -1;
    }
    index.set([4 * s, 4 * s + 1, 4 * s + 2, 4 * s + 2, 4 * s + 1, 4 * s + 3], 6 * s);
  }
  // Called position because three.js counts vertices by it.
  geometry.setAttribute('position', new BufferAttribute(start, 3));
  geometry.setAttribute('segmentEnd', new BufferAttribute(end, 3));
  geometry.setAttribute('corner', new BufferAttribute(corner, 2));
  if (color) geometry.setAttribute('segmentColor', new BufferAttribute(color, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}

const SPREAD = /* glsl */ `
  attribute vec3 segmentEnd;
  attribute vec2 corner;
  uniform vec2 resolution;
  uniform float width;
  uniform float lift;

  vec4 spreadLine() {
    #ifdef USE_INSTANCING
      mat4 toView = modelViewMatrix * instanceMatrix;
    #else
      mat4 toView = modelViewMatrix;
    #endif
    vec4 a = projectionMatrix * (toView * vec4(position, 1.0));
    vec4 b = projectionMatrix * (toView * vec4(segmentEnd, 1.0));
    // Points in front of the near plane have no position on screen: clip.
    float da = a.z + a.w;
    float db = b.z + b.w;
    if (da < 0.0 && db > 0.0) a = mix(a, b, da / (da - db));
    if (db < 0.0 && da > 0.0) b = mix(b, a, db / (db - da));
    vec2 along = (b.xy / b.w - a.xy / a.w) * resolution;
    float size = length(along);
    along = size > 1e-5 ? along / size : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    vec4 p = corner.x < 0.5 ? a : b;
    #ifdef BUTT
      p.xy += across * corner.y * width / resolution * p.w;
    #else
      p.xy += (across * corner.y + along * (2.0 * corner.x - 1.0)) * width / resolution * p.w;
    #endif
    p.z -= lift * p.w;
    return p;
  }
`;

export interface LineOptions {
  /** CSS pixels. */
  readonly width: number;
  readonly color?: string;
  readonly opacity?: number;
  /** Moves lines towards the viewer, as a part of the depth range, so that they stay in front of a surface. */
  readonly lift?: number;
  /** Uses a colour per segment. */
  readonly segmentColors?: boolean;
  /** Uses a colour and opacity per instance, the instanced attribute `tint` (sRGB). */
  readonly tinted?: boolean;
  /** Segments end where their points are: translucent ones of a path don't cover each other. */
  readonly butt?: boolean;
}

export function lineMaterial(options: LineOptions, more: ShaderMaterialParameters = {}): ShaderMaterial {
  return new ShaderMaterial({
    side: DoubleSide,
    transparent: true,
    toneMapped: false,
    defines: {
      ...(options.segmentColors ? { SEGMENT_COLORS: '' } : {}),
      ...(options.tinted ? { TINTED: '' } : {}),
      ...(options.butt ? { BUTT: '' } : {}),
    },
    uniforms: {
      resolution: LINE_RESOLUTION,
      width: { value: options.width },
      lift: { value: options.lift ?? 0 },
      // Raw sRGB: lines are drawn exactly in the theme's colours.
      color: { value: rawColor(options.color ?? '#ffffff') },
      opacity: { value: options.opacity ?? 1 },
    },
    vertexShader: /* glsl */ `
      ${SPREAD}
      uniform vec3 color;
      uniform float opacity;
      #ifdef SEGMENT_COLORS
        attribute vec3 segmentColor;
      #endif
      #ifdef TINTED
        attribute vec4 tint;
      #endif
      varying vec4 vColor;
      void main() {
        vColor = vec4(color, opacity);
        #ifdef TINTED
          vColor = tint;
        #endif
        #ifdef SEGMENT_COLORS
          vColor.rgb = segmentColor;
        #endif
        gl_Position = spreadLine();
      }
    `,
    fragmentShader: /* glsl */ `
      varying vec4 vColor;
      void main() {
        gl_FragColor = vColor;
      }
    `,
    ...more,
  });
}

/** The same lines, drawn as the ids `firstId + instance`. */
export function lineIdMaterial(width: number, lift: number): ShaderMaterial {
  return new ShaderMaterial({
    side: DoubleSide,
    toneMapped: false,
    uniforms: {
      resolution: { value: new Vector2(1, 1) },
      width: { value: width },
      lift: { value: lift },
      firstId: { value: 0 },
    },
    vertexShader: /* glsl */ `
      ${SPREAD}
      uniform float firstId;
      flat varying highp uint vId;
      void main() {
        vId = uint(firstId) + uint(gl_InstanceID);
        gl_Position = spreadLine();
      }
    `,
    fragmentShader: ID_FRAGMENT,
  });
}

/** Writes `vId` as a colour; see `pick-ids.ts`. */
export const ID_FRAGMENT = /* glsl */ `
  flat varying highp uint vId;
  void main() {
    gl_FragColor = vec4(uvec4(vId, vId >> 8u, vId >> 16u, vId >> 24u) & 255u) / 255.0;
  }
`;

/** A theme colour unchanged, for materials that output it as it is. */
export function rawColor(css: string): Color {
  return new Color().setStyle(css, 'srgb-linear');
}
