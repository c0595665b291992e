/**
 * Draws the dope sheet on two canvases: edits and navigation below; playhead, box and readout above, so that playback
 * redraws only a line.
 */

import { markKeys, markMoves, type PixelSpan, PLAIN, SELECTED } from '../../../edit/keys/marks.ts';
import { NO_KEY_SELECTION } from '../../../edit/keys/selection.ts';
import { runsOf } from '../../../evaluate/plot/runs.ts';
import { rangeOfSamples } from '../../../model/takes/samples.ts';
import type { Motion } from '../../../model/takes/take.ts';
import { secondsPerPixel } from '../../widgets/time/time-window.ts';
import { drawOutsideRange, drawPlayhead, drawTimeGrid, type TimeView, translucent } from '../timeline/time-ground.ts';
import { TimePicture } from '../timeline/time-picture.ts';
import { type DiamondSize, Diamonds } from './diamonds.ts';
import {
  type DopeColours,
  drawAttached,
  drawBox,
  drawHeld,
  drawReadout,
  drawSampled,
  drawSheetGround,
  drawStrip,
  PAD,
  readColours,
} from './draw-parts.ts';
import type { AttachedSpan, DopeOverlay, DopeScene } from './scene.ts';
import { HEAD, rowsInView, rowsTop, rowTop } from './sheet.ts';

const BAND_HALF: Readonly<Record<DiamondSize, number>> = { summary: 4, group: 3, channel: 2 };

/** The keys of a row. */
interface RowKeys {
  readonly of: readonly number[];
  readonly span: PixelSpan;
  readonly y: number;
}

export class DopePicture {
  private readonly picture = new TimePicture(readColours);
  readonly element = this.picture.element;
  private diamonds: Diamonds | undefined;
  private diamondsRatio = 0;
  private marks = new Uint8Array(0);
  private moves = new Uint8Array(0);

  /** The theme has changed: rereads the colours on the next drawing. */
  recolour(): void {
    this.picture.recolour();
    this.diamonds = undefined;
  }

  draw(scene: DopeScene): void {
    const { sheet } = scene;
    const g = this.picture.below(sheet.width, sheet.height);
    if (!g) return;
    const colours = this.ready();
    const view = timeView(scene);
    g.fillStyle = colours.surface;
    g.fillRect(0, 0, sheet.width, sheet.height);
    g.save();
    g.beginPath();
    g.rect(0, rowsTop(sheet), sheet.width, Math.max(0, sheet.height - rowsTop(sheet)));
    g.clip();
    this.drawRows(g, scene, view, colours, ...rowsInView(sheet));
    g.restore();
    if (scene.rows.length) {
      g.fillStyle = colours.raised;
      g.fillRect(0, HEAD, sheet.width, sheet.rowHeight);
      this.drawRows(g, scene, view, colours, 0, 1);
      g.fillStyle = colours.line;
      g.fillRect(0, rowsTop(sheet) - 1, sheet.width, 1);
    }
    drawStrip(g, scene, colours);
  }

  drawOverlay(scene: DopeScene, { timeSeconds, box, readout }: DopeOverlay): void {
    const { sheet } = scene;
    const g = this.picture.above(sheet.width, sheet.height);
    if (!g) return;
    const colours = this.ready();
    drawPlayhead(g, timeView(scene), timeSeconds, sheet.height, colours);
    if (box) drawBox(g, sheet, box, colours);
    if (readout) drawReadout(g, sheet, readout, colours);
  }

  private ready(): DopeColours {
    const { colours } = this.picture;
    if (!this.diamonds || this.diamondsRatio !== window.devicePixelRatio) {
      this.diamondsRatio = window.devicePixelRatio;
      const { key, selected, surface } = colours;
      this.diamonds = new Diamonds({ key, selected, rim: surface }, this.diamondsRatio);
    }
    return colours;
  }

  /** Rows `first` up to `end`, with backgrounds and keys. */
  private drawRows(
    g: CanvasRenderingContext2D,
    scene: DopeScene,
    view: TimeView,
    colours: DopeColours,
    first: number,
    end: number,
  ): void {
    const { sheet, rows } = scene;
    for (let i = first; i < end; i++) drawSheetGround(g, sheet, i, rows[i], scene.isSelected(rows[i]), colours);
    const top = rowTop(sheet, first);
    const bottom = first < end ? rowTop(sheet, end - 1) + sheet.rowHeight : top;
    const outside = { ...colours, outside: translucent(colours.outside, 0.7) };
    drawOutsideRange(g, view, top, bottom, outside);
    drawTimeGrid(g, view, top, bottom, colours);
    for (let i = first; i < end; i++) this.drawKeys(g, scene, i, colours);
  }

  private drawKeys(g: CanvasRenderingContext2D, scene: DopeScene, row: number, colours: DopeColours): void {
    const { sheet, rows, channels, curves, selected, offsetSeconds } = scene;
    const pixels = Math.ceil(sheet.width) + 2 * PAD;
    if (this.marks.length !== pixels) {
      this.marks = new Uint8Array(pixels);
      this.moves = new Uint8Array(pixels);
    }
    const { marks, moves, diamonds } = this;
    const { channels: of, kind, characterId, sampled } = rows[row];
    const pixel = secondsPerPixel(sheet);
    const span = { from: sheet.window.from + offsetSeconds - PAD * pixel, secondsPerPixel: pixel };
    const y = rowTop(sheet, row) + sheet.rowHeight / 2;
    if (kind === 'attached') {
      const own = (span: AttachedSpan) => characterId === undefined || span.characterId === characterId;
      drawAttached(g, sheet, scene.attached.filter(own), y, colours);
      return;
    }
    if (curves.samples && of.some((channel) => curves.columns[channel] >= 0)) {
      const [from, to] = rangeOfSamples(curves.samples);
      drawSampled(g, sheet, from - offsetSeconds, to - offsetSeconds, y, colours);
    }
    if (sampled) drawSampled(g, sheet, ...sampled, y, colours);
    for (const motion of scene.others) this.drawOther(g, scene, motion, { of, span, y }, colours);
    const ends = markMoves(curves, of, span, moves);
    if (ends) drawHeld(g, moves, ends, y, colours);
    markKeys(channels, of, selected, span, marks);
    const size = kind === 'summary' || kind === 'character' ? 'summary' : kind === 'channel' ? 'channel' : 'group';
    const half = BAND_HALF[size];
    runsOf(marks, {
      diamond: (at, mark) => diamonds?.draw(g, at - PAD + 0.5, y, size, mark),
      band(from, to, mark) {
        g.fillStyle = mark === SELECTED ? colours.selected : colours.band;
        g.fillRect(from - PAD, y - half, to - from + 1, 2 * half);
        if (mark !== (PLAIN | SELECTED)) return;
        g.fillStyle = colours.selected;
        g.fillRect(from - PAD, y - half, to - from + 1, half);
      },
    });
  }

  /** Keys and samples of another layer, or of the base. */
  private drawOther(
    g: CanvasRenderingContext2D,
    { sheet, offsetSeconds }: DopeScene,
    { channels, samples }: Motion,
    { of, span, y }: RowKeys,
    colours: DopeColours,
  ): void {
    if (samples && of.some((channel) => channels[channel]?.kind === 'samples')) {
      const [from, to] = rangeOfSamples(samples);
      drawSampled(g, sheet, from - offsetSeconds, to - offsetSeconds, y, colours);
    }
    markKeys(channels, of, NO_KEY_SELECTION, span, this.marks);
    g.fillStyle = colours.held;
    const tick = (from: number, to: number) => g.fillRect(from - PAD, y - OTHER_HALF, to - from + 1, 2 * OTHER_HALF);
    runsOf(this.marks, { diamond: (at) => tick(at, at), band: tick });
  }
}

/** Half the height of a tick for a key of another layer. */
const OTHER_HALF = 3;

function timeView({ sheet, range, framesPerSecond, inFrames }: DopeScene): TimeView {
  return { window: sheet.window, width: sheet.width, range, framesPerSecond, inFrames };
}
