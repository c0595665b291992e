/**
 * The grid: one-pixel lines at any scale, drawn by a shader on one quad, with coordinates along its axes.
 *
 * Lines come from the distance to the nearest multiple of the spacing, measured in pixels through screen derivatives
 * (after Ben Golus, "The Best Darn Grid Shader (Yet)", 2023), and fade where they come closer than a few pixels, which
 * prevents moiré in the distance. Coordinates in the shader are relative to a multiple of the spacing near the camera's
 * target, so that floats stay precise far from the origin. It is on the ground; in an orthographic front or side view
 * it is upright behind everything, as in other tools.
 */
import {
  AddEquation,
  BufferAttribute,
  BufferGeometry,
  Color,
  CustomBlending,
  DoubleSide,
  Group,
  Mesh,
  OneFactor,
  OneMinusSrcAlphaFactor,
  ShaderMaterial,
  SrcAlphaFactor,
  Vector2,
  Vector3,
} from 'three';
import { gridLabel, roundStep, subdivisions } from '../../math/round-steps.ts';
import type { StageTheme } from '../theme.ts';
import { Glyphs } from './glyphs.ts';
import { rawColor } from './thick-lines.ts';

/** The two axes that the grid spans. */
export type GridPlane = 'ground' | 'front' | 'side';

/** Axis indices (u, v) of each plane. */
const AXES: Readonly<Record<GridPlane, readonly [number, number]>> = { ground: [0, 2], front: [0, 1], side: [2, 1] };

/** Minimum CSS pixels between labelled lines at the camera's target. */
const SPACING_PX = 92;
/** How far from the target lines are labelled, in spacings. */
const LABEL_REACH = 4;
/** Numbers that the labels depend on: see `writeLabels`. */
const LABELS_DEPEND_ON = 11;
/** Before the characters: nothing of the floor is ever drawn over a body. Its shadow is drawn between (`stage.ts`). */
const LINES_ORDER = -900;
const NUMBERS_ORDER = -840;

export interface GridView {
  readonly target: Vector3;
  /** From the camera to its target. */
  readonly distance: number;
  /** World length of a CSS pixel at the target. */
  readonly unitsPerPixel: number;
  readonly plane: GridPlane;
}

export class Grid {
  readonly object = new Group();
  /** Spacing of the finest lines. */
  step = 0.1;
  /** Of the labelled ones. */
  /** World height of the grid on the ground. */
  floor = 0;
  private spacing = 1;
  private readonly quad: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly glyphs = new Glyphs(512);
  private readonly labelColor = new Color();
  private poolOpacity = 0;
  private readonly axisColors = [new Color(), new Color(), new Color()];
  private readonly at = [0, 0, 0];
  private readonly drawnFor = { target: new Vector3(Number.NaN), distance: 0, unitsPerPixel: 0, plane: '' };
  /** What the labels that are there were written for. */
  private readonly labelledFor = new Float64Array(LABELS_DEPEND_ON);
  private readonly labelsFor = new Float64Array(LABELS_DEPEND_ON);

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute(
      'position',
      new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0]), 3),
    );
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    this.quad = new Mesh(geometry, gridMaterial());
    this.quad.frustumCulled = false;
    this.quad.matrixAutoUpdate = false;
    this.quad.renderOrder = LINES_ORDER;
    this.glyphs.object.renderOrder = NUMBERS_ORDER;
    this.object.add(this.quad, this.glyphs.object);
  }

  setTheme(theme: StageTheme): void {
    const { uniforms } = this.quad.material;
    uniforms.majorColor.value.copy(rawColor(theme.gridMajor));
    uniforms.minorColor.value.copy(rawColor(theme.gridMinor));
    uniforms.opacity.value.set(theme.gridMinorOpacity, theme.gridMajorOpacity);
    [theme.axisX, theme.axisY, theme.axisZ].forEach((css, i) => {
      this.axisColors[i].copy(rawColor(css));
    });
    uniforms.poolColor.value.copy(rawColor(theme.pool));
    this.poolOpacity = theme.poolOpacity;
    this.labelColor.copy(rawColor(theme.gridLabel));
    this.glyphs.setHalo(theme.labelHalo);
    this.redraw();
  }

  setPixelRatio(ratio: number): void {
    this.glyphs.setPixelRatio(ratio);
    this.redraw();
  }

  /** Distance from the target at which lines have faded out. */
  static reach(distance: number): number {
    return 2.6 * distance;
  }

  /** Call every frame in which the camera moved. */
  update({ target, distance, unitsPerPixel, plane }: GridView): void {
    const { drawnFor } = this;
    this.object.position.y = plane === 'ground' ? this.floor : 0;
    if (
      drawnFor.target.equals(target) &&
      drawnFor.distance === distance &&
      drawnFor.unitsPerPixel === unitsPerPixel &&
      drawnFor.plane === plane
    ) {
      return;
    }
    drawnFor.target.copy(target);
    Object.assign(drawnFor, { distance, unitsPerPixel, plane });
    const [u, v] = AXES[plane];
    const spacing = roundStep(SPACING_PX * unitsPerPixel);
    this.spacing = spacing;
    this.step = spacing / subdivisions(spacing);
    const radius = Grid.reach(distance);
    const tu = target.getComponent(u);
    const tv = target.getComponent(v);
    const originU = Math.round(tu / spacing) * spacing;
    const originV = Math.round(tv / spacing) * spacing;

    const { uniforms } = this.quad.material;
    uniforms.spacing.value.set(this.step, spacing);
    uniforms.centre.value.set(tu - originU, tv - originV);
    uniforms.zero.value.set(-originU, -originV);
    uniforms.radius.value = radius;
    uniforms.uColor.value.copy(this.axisColors[u]);
    uniforms.vColor.value.copy(this.axisColors[v]);
    uniforms.pool.value = plane === 'ground' ? this.poolOpacity : 0;

    const m = this.quad.matrix.identity().elements;
    m.fill(0, 0, 12);
    m[u] = radius;
    m[4 + v] = radius;
    m[12 + u] = originU;
    m[12 + v] = originV;
    this.quad.matrixWorldNeedsUpdate = true;

    this.writeLabels(u, v, tu, tv);
  }

  dispose(): void {
    this.quad.geometry.dispose();
    this.quad.material.dispose();
    this.glyphs.dispose();
  }

  /** Colours or sizes have changed. */
  private redraw(): void {
    this.drawnFor.distance = Number.NaN;
    this.labelledFor.fill(Number.NaN);
  }

  /**
   * Labels both axes, or the nearest labelled lines if the axes are out of view. They fade with the distance to the
   * target, in the shader: while the camera follows a character, labels are only written when others come into reach.
   */
  private writeLabels(u: number, v: number, tu: number, tv: number): void {
    const { spacing, at, glyphs, labelsFor, labelledFor } = this;
    const near = LABEL_REACH * spacing;
    glyphs.fadeAround(this.drawnFor.target, near);
    labelsFor[0] = spacing;
    labelsFor[1] = u;
    labelsFor[2] = v;
    this.noteReach(3, tu, tv);
    this.noteReach(7, tv, tu);
    if (labelsFor.every((value, i) => value === labelledFor[i])) return;
    labelledFor.set(labelsFor);
    glyphs.begin();
    for (let o = 3; o < LABELS_DEPEND_ON; o += 4) {
      const [along, across] = o === 3 ? [u, v] : [v, u];
      const [first, last, named, acrossValue] = labelsFor.subarray(o, o + 4);
      // So far away that one line isn't told from the next.
      if (!Number.isSafeInteger(first) || !Number.isSafeInteger(last)) continue;
      at.fill(0);
      at[across] = acrossValue;
      for (let i = first; i <= last; i++) {
        // A single 0 for both axes.
        if (i === 0 && along === v && acrossValue === 0) continue;
        at[along] = i * spacing;
        glyphs.add(gridLabel(i, spacing), at, 4, -8, this.labelColor, 0.9, along);
      }
      // The axis's name, on the other side of its line, where labels begin to fade.
      if (acrossValue === 0 && named > 0) {
        at[along] = named * spacing;
        glyphs.add('xyz'[along], at, 4, 9, this.axisColors[along], 1, -1);
      }
    }
    glyphs.end();
  }

  /**
   * Of the labels along an axis, into `labelsFor` from `o` on: the first and last line, that of the axis's name, and
   * where they are across it.
   */
  private noteReach(o: number, centre: number, across: number): void {
    const { spacing, labelsFor } = this;
    const near = LABEL_REACH * spacing;
    labelsFor[o] = Math.ceil((centre - near) / spacing);
    labelsFor[o + 1] = Math.floor((centre + near) / spacing);
    labelsFor[o + 2] = Math.floor((centre + 0.7 * near) / spacing);
    labelsFor[o + 3] = Math.abs(across) < near ? 0 : Math.round(across / spacing) * spacing;
  }
}

function gridMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    side: DoubleSide,
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    // Custom, so that it blends in the opaque list, which is drawn first.
    blending: CustomBlending,
    blendEquation: AddEquation,
    blendSrc: SrcAlphaFactor,
    blendDst: OneMinusSrcAlphaFactor,
    // Keeps the canvas opaque: the page would show through its lines.
    blendSrcAlpha: OneFactor,
    blendDstAlpha: OneMinusSrcAlphaFactor,
    uniforms: {
      spacing: { value: new Vector2(0.2, 1) },
      centre: { value: new Vector2() },
      zero: { value: new Vector2() },
      radius: { value: 1 },
      opacity: { value: new Vector2(0.1, 0.25) },
      minorColor: { value: new Color() },
      majorColor: { value: new Color() },
      uColor: { value: new Color() },
      vColor: { value: new Color() },
      pool: { value: 0 },
      poolColor: { value: new Color() },
    },
    vertexShader: /* glsl */ `
      uniform float radius;
      varying vec2 vAt;
      void main() {
        vAt = position.xy * radius;
        gl_Position = projectionMatrix * (modelViewMatrix * vec4(position, 1.0));
      }
    `,
    fragmentShader: /* glsl */ `
      uniform vec2 spacing;
      uniform vec2 centre;
      uniform vec2 zero;
      uniform vec2 opacity;
      uniform float radius;
      uniform vec3 minorColor;
      uniform vec3 majorColor;
      uniform vec3 uColor;
      uniform vec3 vColor;
      uniform float pool;
      uniform vec3 poolColor;
      varying vec2 vAt;

      // Coverage of this pixel by lines \`every\` apart, for lines across u (.x) and v (.y).
      vec2 lines(vec2 at, vec2 pixel, float every, float width) {
        vec2 cells = at / every;
        vec2 size = pixel / every;
        vec2 away = abs(fract(cells - 0.5) - 0.5) / size;
        vec2 cover = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, away);
        // Fade below 12 pixels, gone below 4.
        return cover * (1.0 - smoothstep(1.0 / 12.0, 1.0 / 4.0, size));
      }

      void main() {
        vec2 dx = dFdx(vAt);
        vec2 dy = dFdy(vAt);
        vec2 pixel = max(sqrt(vec2(dx.x * dx.x + dy.x * dy.x, dx.y * dx.y + dy.y * dy.y)), vec2(1e-12));
        vec2 minor = lines(vAt, pixel, spacing.x, 1.0) * opacity.x;
        vec2 major = lines(vAt, pixel, spacing.y, 1.0) * opacity.y;
        vec4 color = vec4(minorColor, max(minor.x, minor.y));
        float strong = max(major.x, major.y);
        color = strong > color.a ? vec4(majorColor, strong) : color;
        // v is 0 along the first axis, u along the second.
        vec2 axis = 1.0 - smoothstep(vec2(0.3), vec2(1.3), abs(vAt - zero) / pixel);
        if (axis.y > 0.0) color = vec4(mix(color.rgb, uColor, axis.y), max(color.a, 0.5 * axis.y));
        if (axis.x > 0.0) color = vec4(mix(color.rgb, vColor, axis.x), max(color.a, 0.5 * axis.x));
        float away = length(vAt - centre) / radius;
        float fade = 1.0 - smoothstep(0.05, 1.0, away);
        color.a *= fade * fade;
        // Light on the floor, under the lines.
        float lit = pool * exp(-26.0 * away * away) * (1.0 - color.a);
        color = vec4((color.rgb * color.a + poolColor * lit) / max(color.a + lit, 1e-6), color.a + lit);
        if (color.a < 0.002) discard;
        gl_FragColor = color;
      }
    `,
  });
}
