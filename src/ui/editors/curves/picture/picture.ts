/**
 * The curve editor's canvases, one over the other, so that playback redraws only the playhead.
 *
 *     overlay    playhead, the hovered curve and its name, selection box
 *     labels     of values, and names at the curves' ends
 *     keys       diamonds, tangent handles of selected ones
 *     curves      over what is below the active layer
 *     ground     range, grid, limits
 *
 * While a curve is hovered, all others and their keys are faint: two layers change their opacity, and nothing is
 * traced. A layer is redrawn when an object that it draws has been replaced; lines are traced again one by one
 * (`picture-curves.ts`).
 */

import { keysOf } from '../../../../model/takes/take.ts';
import { element } from '../../../widgets/dom.ts';
import { timeX } from '../../../widgets/time/time-window.ts';
import type { SelectionBox } from '../../timeline/box.ts';
import { drawPlayhead } from '../../timeline/time-ground.ts';
import { mixed } from '../scene/colours.ts';
import { handleOf } from '../scene/handles.ts';
import { type CurveHit, type CurveLine, type CurveScene, lineOf } from '../scene/scene.ts';
import { yOf } from '../scene/space.ts';
import { drawCurveGround, drawLimits, drawValueLabels, timeView } from './grid.ts';
import { drawHoveredName, drawNames } from './names.ts';
import { type PictureColours, readPictureColours } from './picture-colours.ts';
import { CurveLayer } from './picture-curves.ts';
import { drawKeys, drawKeysOf, KEY_PIXELS } from './picture-keys.ts';
import { drawRest } from './picture-rest.ts';
import { drawTheirs } from './picture-theirs.ts';

const HOVER_WIDTH = 2.5;
/** Of the curves that aren't hovered while one is. */
const OTHERS_OPACITY = '0.45';

export class CurvePicture {
  /** Fills its container and takes no pointer events: listen on the container. */
  readonly element: HTMLElement;
  private readonly ground = new Layer();
  private readonly curves = new Layer();
  private readonly keys = new Layer();
  private readonly labels = new Layer();
  private readonly overlay = new Layer();
  private readonly layers = [this.ground, this.curves, this.keys, this.labels, this.overlay];
  private readonly lines = new CurveLayer();
  private colours: PictureColours | undefined;
  private isWhole = true;
  private scene: CurveScene | undefined;

  /** @param host positioned; the canvases fill it */
  constructor(host: HTMLElement) {
    this.element = element(
      'div',
      { class: 'curve-picture', 'aria-hidden': 'true' },
      ...this.layers.map(({ canvas }) => canvas),
    );
    Object.assign(this.element.style, { position: 'absolute', inset: '0', pointerEvents: 'none', overflow: 'hidden' });
    host.append(this.element);
  }

  /**
   * Redraws what differs from the previous scene, by identity of its parts. The overlay is drawn separately.
   *
   * @returns whether it is done; many lines take several frames, with a call in each
   */
  draw(scene: CurveScene): boolean {
    const before = this.scene;
    this.scene = scene;
    const { width, height } = scene.space;
    if (!(width > 0 && height > 0)) return true;
    const ratio = window.devicePixelRatio;
    this.colours ??= readPictureColours(this.element);
    // All, since each has to be resized.
    const resized = this.layers.filter((layer) => layer.resize(width, height, ratio));
    const all = resized.length > 0 || !before || !sameGround(before, scene);
    if (all || !this.isWhole || !sameEmphasis(before, scene)) this.drawCurves(scene, ratio, this.colours);
    if (all || before.selected !== scene.selected || before.emphasised !== scene.emphasised) {
      const { colours } = this;
      this.keys.setVisible(this.keys.draw((g) => drawKeys(g, scene, colours)) === true);
    }
    return this.isWhole;
  }

  /** Draws the playhead (the transport's seconds), the hover highlight and the selection box; no other layer. */
  drawOverlay(timeSeconds: number, hover?: CurveHit, box?: SelectionBox): void {
    const { scene, colours } = this;
    if (!scene || !colours) return;
    const opacity = hover && hover.kind !== 'empty' && lineOf(scene, hover.channel) ? OTHERS_OPACITY : '';
    for (const { canvas } of [this.curves, this.keys]) canvas.style.opacity = opacity;
    this.overlay.draw((g) => {
      if (hover) this.drawHover(g, scene, hover, colours);
      if (box) drawBox(g, box, colours);
      drawPlayhead(g, timeView(scene), timeSeconds, scene.space.height, colours.time);
    });
  }

  /** The theme has changed: rereads the colours and redraws everything. */
  recolour(): void {
    this.colours = undefined;
    const { scene } = this;
    this.scene = undefined;
    if (scene) this.draw(scene);
  }

  private drawCurves(scene: CurveScene, ratio: number, colours: PictureColours): void {
    const standOut = withSelectedKeys(scene);
    const limited = scene.lines.filter((line) => standOut.has(line.channel));
    this.ground.draw((g) => {
      drawCurveGround(g, scene, colours);
      drawLimits(g, scene, limited, ratio, colours);
    });
    this.curves.draw((g) => {
      drawRest(g, scene, colours);
      this.isWhole = this.lines.draw(g, { scene, standOut, ratio, palette: colours.palette, ground: colours.plot });
      drawTheirs(g, scene, colours);
    });
    this.labels.draw((g) => {
      drawValueLabels(g, scene, colours);
      drawNames(g, scene, colours);
    });
  }

  private drawHover(g: CanvasRenderingContext2D, scene: CurveScene, hover: CurveHit, colours: PictureColours): void {
    if (hover.kind === 'empty') return;
    const line = lineOf(scene, hover.channel);
    if (!line) return;
    g.save();
    g.beginPath();
    g.rect(0, 0, scene.space.width, scene.space.height);
    g.clip();
    g.strokeStyle = mixed(line.colour, colours.palette);
    g.lineWidth = HOVER_WIDTH;
    this.lines.outline(g, line.channel);
    drawKeysOf(g, scene, line, colours);
    drawHoveredName(g, scene, line, colours);
    g.strokeStyle = colours.hover;
    if (hover.kind === 'curve') {
      g.fillStyle = colours.hover;
      const x = timeX(scene.space, hover.timeSeconds - scene.offsetSeconds);
      dot(g, x, yOf(scene.space, line, hover.value), 2.5);
      g.fill();
    } else ringAround(g, scene, line, hover);
    g.restore();
  }
}

function ringAround(
  g: CanvasRenderingContext2D,
  scene: CurveScene,
  line: CurveLine,
  hover: Extract<CurveHit, { kind: 'key' | 'handle' }>,
): void {
  const { times, values } = keysOf(scene.take.channels[line.channel]);
  // The hovered key may have been deleted.
  if (hover.index >= times.length) return;
  g.lineWidth = 1.5;
  if (hover.kind === 'key') {
    const x = timeX(scene.space, times[hover.index] - scene.offsetSeconds);
    dot(g, x, yOf(scene.space, line, values[hover.index]), KEY_PIXELS + 3);
  } else {
    const { endX, endY } = handleOf(scene, line, hover.index, hover.side);
    dot(g, endX, endY, KEY_PIXELS + 2);
  }
  g.stroke();
}

function dot(g: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  g.beginPath();
  g.arc(x, y, radius, 0, 2 * Math.PI);
}

function drawBox(g: CanvasRenderingContext2D, { x0, y0, x1, y1 }: SelectionBox, colours: PictureColours): void {
  const left = Math.round(Math.min(x0, x1)) + 0.5;
  const top = Math.round(Math.min(y0, y1)) + 0.5;
  const width = Math.round(Math.abs(x1 - x0));
  const height = Math.round(Math.abs(y1 - y0));
  g.fillStyle = colours.boxFill;
  g.strokeStyle = colours.boxLine;
  g.lineWidth = 1;
  g.fillRect(left, top, width, height);
  g.strokeRect(left, top, width, height);
}

/** Channels with selected keys: their lines are wider, and their limits hatched. */
function withSelectedKeys({ selected }: CurveScene): Set<number> {
  return new Set(selected.map((keys) => keys.channel));
}

function sameEmphasis(a: CurveScene, b: CurveScene): boolean {
  if (a.emphasised !== b.emphasised) return false;
  if (a.selected === b.selected) return true;
  const [before, now] = [withSelectedKeys(a), withSelectedKeys(b)];
  return before.size === now.size && [...now].every((channel) => before.has(channel));
}

/** Whether everything below the selection is unchanged. */
function sameGround(a: CurveScene, b: CurveScene): boolean {
  return (
    a.take === b.take &&
    a.offsetSeconds === b.offsetSeconds &&
    a.lines === b.lines &&
    a.rest === b.rest &&
    a.theirs === b.theirs &&
    a.space === b.space &&
    a.range[0] === b.range[0] &&
    a.range[1] === b.range[1] &&
    a.framesPerSecond === b.framesPerSecond &&
    a.inFrames === b.inFrames &&
    a.degrees === b.degrees
  );
}

/** A canvas in CSS pixels with the screen's resolution. */
class Layer {
  readonly canvas: HTMLCanvasElement = element('canvas');
  private ratio = 1;

  constructor() {
    Object.assign(this.canvas.style, { position: 'absolute', left: '0', top: '0' });
  }

  /** @returns whether its size has changed, so that it must be redrawn */
  resize(width: number, height: number, ratio: number): boolean {
    const { canvas } = this;
    const wide = Math.max(1, Math.ceil(width * ratio));
    const high = Math.max(1, Math.ceil(height * ratio));
    if (canvas.width === wide && canvas.height === high && this.ratio === ratio) return false;
    this.ratio = ratio;
    canvas.width = wide;
    canvas.height = high;
    // Not 100 %: unless a whole number of device pixels, lines would be blurred.
    canvas.style.width = `${wide / ratio}px`;
    canvas.style.height = `${high / ratio}px`;
    return true;
  }

  /** Returns what `paint` returns. */
  draw<T>(paint: (g: CanvasRenderingContext2D) => T): T | undefined {
    const g = this.canvas.getContext('2d');
    if (!g) return undefined;
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    g.clearRect(0, 0, this.canvas.width, this.canvas.height);
    return paint(g);
  }

  /** Chromium may keep showing the old content of a canvas that is only cleared: hide an empty one. */
  setVisible(visible: boolean): void {
    this.canvas.style.visibility = visible ? '' : 'hidden';
  }
}
