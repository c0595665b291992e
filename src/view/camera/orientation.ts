/**
 * The axis widget in the corner: shows the camera's orientation, with six buttons to look along an axis. HTML and SVG,
 * so that buttons are accessible; updated only when the camera turns.
 *
 *     x right side … a button's place is the axis in the camera's space:  (m · e).xy,  behind where z is smaller
 */
import type { Camera } from 'three';
import type { StageTheme } from '../theme.ts';
import type { ViewDirection } from './camera.ts';

const SIZE = 56;
/** Diameter of the area that can be pressed, larger than what is drawn. */
const TARGET = 24;
/** Radii in pixels: of a positive end, a negative one, and the latter's hole. */
const [BALL, RING, HOLE] = [8, 4.5, 3.2];
/** From the centre to a button's centre. */
const ARM = 20;
const SVG = 'http://www.w3.org/2000/svg';

interface Arm {
  readonly side: ViewDirection;
  readonly axis: 0 | 1 | 2;
  readonly sign: 1 | -1;
  readonly label: string;
}

const ARMS: readonly Arm[] = [
  { side: 'left', axis: 0, sign: 1, label: 'Look from +x' },
  { side: 'right', axis: 0, sign: -1, label: 'Look from −x' },
  { side: 'top', axis: 1, sign: 1, label: 'Look from +y, the top' },
  { side: 'bottom', axis: 1, sign: -1, label: 'Look from −y, the bottom' },
  { side: 'front', axis: 2, sign: 1, label: 'Look from +z, the front' },
  { side: 'back', axis: 2, sign: -1, label: 'Look from −z, the back' },
];

export class Orientation {
  readonly element = document.createElement('div');
  private readonly buttons: HTMLButtonElement[];
  private readonly lines: SVGLineElement[] = [];
  private readonly last = new Float64Array(9).fill(Number.NaN);
  private colors: readonly string[] = ['', '', ''];

  constructor(lookFrom: (side: ViewDirection) => void) {
    const { element } = this;
    element.setAttribute('role', 'group');
    element.setAttribute('aria-label', 'Look along an axis');
    element.style.cssText = `position:absolute;right:14px;top:var(--axis-widget-top,12px);width:${SIZE}px;height:${SIZE}px;pointer-events:none`;
    const svg = document.createElementNS(SVG, 'svg');
    svg.setAttribute('viewBox', `${-SIZE / 2} ${-SIZE / 2} ${SIZE} ${SIZE}`);
    svg.setAttribute('aria-hidden', 'true');
    svg.style.cssText = 'position:absolute;inset:0;overflow:visible';
    for (let i = 0; i < 3; i++) {
      const line = document.createElementNS(SVG, 'line');
      line.setAttribute('stroke-width', '2');
      line.setAttribute('stroke-linecap', 'round');
      svg.append(line);
      this.lines.push(line);
    }
    element.append(svg);
    this.buttons = ARMS.map(({ side, axis, sign, label }) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.setAttribute('aria-label', label);
      button.textContent = sign > 0 ? 'xyz'[axis] : '';
      button.style.cssText =
        `position:absolute;left:50%;top:50%;width:${TARGET}px;height:${TARGET}px;margin:${-TARGET / 2}px;padding:0;` +
        'border-radius:50%;border:0;font:600 10px/1 system-ui,sans-serif;forced-color-adjust:none;' +
        'display:grid;place-items:center;cursor:pointer;pointer-events:auto;user-select:none';
      button.addEventListener('click', () => lookFrom(side));
      element.append(button);
      return button;
    });
  }

  setTheme(theme: StageTheme): void {
    this.colors = [theme.axisX, theme.axisY, theme.axisZ];
    ARMS.forEach(({ axis, sign }, i) => {
      const { style } = this.buttons[i];
      const color = this.colors[axis];
      const drawn =
        sign > 0
          ? `${color} ${BALL - 0.5}px, transparent ${BALL + 0.5}px`
          : `${theme.labelHalo} ${HOLE - 0.5}px, ${color} ${HOLE + 0.5}px ${RING - 0.5}px, transparent ${RING + 0.5}px`;
      style.background = `radial-gradient(circle, ${drawn})`;
      style.color = theme.labelHalo;
    });
    this.lines.forEach((line, i) => {
      line.setAttribute('stroke', this.colors[i]);
    });
    this.last.fill(Number.NaN);
  }

  /** Call every frame: moves the arms if the camera turned. */
  update(camera: Camera): void {
    const m = camera.matrixWorldInverse.elements;
    let turned = false;
    for (let axis = 0; axis < 3; axis++) {
      for (let k = 0; k < 3; k++) {
        turned ||= !(Math.abs(this.last[3 * axis + k] - m[4 * axis + k]) < 1e-5);
        this.last[3 * axis + k] = m[4 * axis + k];
      }
    }
    if (!turned) return;
    for (let i = 0; i < ARMS.length; i++) {
      const { axis, sign } = ARMS[i];
      const x = sign * m[4 * axis] * ARM;
      const y = -sign * m[4 * axis + 1] * ARM;
      const depth = sign * m[4 * axis + 2];
      const { style } = this.buttons[i];
      style.transform = `translate(${x.toFixed(2)}px,${y.toFixed(2)}px)`;
      style.zIndex = String(10 + Math.round(8 * depth));
      style.opacity = (0.78 + 0.22 * depth).toFixed(2);
      if (sign > 0) {
        // An equal write would be drawn too.
        for (const [end, to] of [
          ['x2', x.toFixed(2)],
          ['y2', y.toFixed(2)],
        ] as const) {
          if (this.lines[axis].getAttribute(end) !== to) this.lines[axis].setAttribute(end, to);
        }
        this.lines[axis].style.opacity = (0.7 + 0.3 * depth).toFixed(2);
      }
    }
  }
}
