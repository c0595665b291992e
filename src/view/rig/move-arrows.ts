/**
 * Three arrows that move the selected joint, of constant size on screen. Not three.js's TransformControls: these only
 * move, and the page's own router gives them the pointer.
 */
import { ConeGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from 'three';
import type { CameraProjection } from '../camera/camera-projection.ts';
import { lineMaterial, rawColor, segmentsGeometry } from '../scene/thick-lines.ts';
import type { StageTheme } from '../theme.ts';
import { AXES, type Axis } from './rig-screen.ts';

/** CSS pixels from the joint to an arrow's tip and start. */
const LENGTH = 78;
const START = 16;
/** Arrows shorter than this on screen point at the viewer or away, and are hidden. */
const MIN_PIXELS = 14;

const UP = new Vector3(0, 1, 0);

export class MoveArrows {
  readonly object = new Group();
  /** x y of start and tip of each, 4 numbers per axis; NaN if not drawn. */
  readonly screen = new Float64Array(12).fill(Number.NaN);
  private readonly arrows: readonly Arrow[];
  private readonly direction = new Vector3();
  private hot: Axis | undefined;
  private theme: StageTheme | undefined;

  constructor() {
    this.arrows = AXES.map(() => new Arrow());
    for (const arrow of this.arrows) this.object.add(arrow.object);
    this.hide();
  }

  /** @param axis the one under the pointer */
  light(axis: Axis | undefined): void {
    if (axis === this.hot) return;
    this.hot = axis;
    this.paint();
  }

  /**
   * @param at world matrix, in `at[o …]`, whose translation is their origin
   * @param along matrix, in `along[a …]`, whose columns are their directions
   */
  place(projection: CameraProjection, at: Float64Array, o: number, along: Float64Array, a: number): void {
    const [x, y, z] = [at[o + 12], at[o + 13], at[o + 14]];
    const perPixel = projection.unitsPerPixelAt(x, y, z);
    const { screen, direction } = this;
    for (const axis of AXES) {
      const arrow = this.arrows[axis];
      direction.set(along[a + 4 * axis], along[a + 4 * axis + 1], along[a + 4 * axis + 2]);
      const size = direction.length();
      arrow.object.visible = perPixel > 0 && size > 0;
      if (!arrow.object.visible) {
        screen.fill(Number.NaN, 4 * axis, 4 * axis + 4);
        continue;
      }
      direction.divideScalar(size);
      const reach = (pixels: number, to: number) => {
        const d = pixels * perPixel;
        projection.toPixels(x + d * direction.x, y + d * direction.y, z + d * direction.z, screen, to);
      };
      reach(START, 4 * axis);
      reach(LENGTH, 4 * axis + 2);
      const dx = screen[4 * axis + 2] - screen[4 * axis];
      const dy = screen[4 * axis + 3] - screen[4 * axis + 1];
      if (!(Math.hypot(dx, dy) >= MIN_PIXELS)) {
        arrow.object.visible = false;
        screen.fill(Number.NaN, 4 * axis, 4 * axis + 4);
        continue;
      }
      arrow.object.position.set(x, y, z);
      arrow.object.quaternion.setFromUnitVectors(UP, direction);
      arrow.object.scale.setScalar(perPixel * LENGTH);
    }
  }

  hide(): void {
    for (const arrow of this.arrows) arrow.object.visible = false;
    this.screen.fill(Number.NaN);
  }

  setTheme(theme: StageTheme): void {
    this.theme = theme;
    this.paint();
  }

  dispose(): void {
    for (const arrow of this.arrows) arrow.dispose();
  }

  private paint(): void {
    const { theme } = this;
    if (!theme) return;
    const colors = [theme.axisX, theme.axisY, theme.axisZ];
    for (const axis of AXES) this.arrows[axis].setColor(axis === this.hot ? theme.hovered : colors[axis]);
  }
}

/** An arrow along +y, from `START` to 1. */
class Arrow {
  readonly object = new Group();
  private readonly line = lineMaterial({ width: 2 }, { depthTest: false, depthWrite: false });
  private readonly head = new MeshBasicMaterial({
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    transparent: true,
  });
  private readonly shaft = segmentsGeometry([0, START / LENGTH, 0, 0, 0.84, 0]);
  private readonly cone = new ConeGeometry(0.065, 0.2, 16).translate(0, 0.9, 0);

  constructor() {
    const shaft = new Mesh(this.shaft, this.line);
    const cone = new Mesh(this.cone, this.head);
    for (const mesh of [shaft, cone]) {
      mesh.frustumCulled = false;
      mesh.renderOrder = 44;
      this.object.add(mesh);
    }
  }

  setColor(css: string): void {
    this.line.uniforms.color.value.copy(rawColor(css));
    this.head.color.set(css);
  }

  dispose(): void {
    for (const part of [this.line, this.head, this.shaft, this.cone]) part.dispose();
  }
}
