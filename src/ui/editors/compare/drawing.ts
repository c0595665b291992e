/**
 * Draws what is compared with another program's numbers over the viewport, at the times that were compared: joints by
 * how they compare, theirs as a ghost, vertices coloured by their errors, with a legend. Loaded with the first
 * comparison.
 */

import { type Character, shownSkin } from '../../../model/document.ts';
import { jointMarks } from '../../../teaching/compare/joint-marks.ts';
import { type ComparedDrawing, CompareOverlay } from '../../../view/compare/compare-overlay.ts';
import type { ComparedSide } from '../../../view/compare/compared-skeleton.ts';
import type { Look } from '../../../view/look.ts';
import { isOpaque } from '../../../view/skeleton/skeleton-drawing.ts';
import type { ComparedResult, ShownComparison } from '../../state/dump-comparison.ts';
import { lengthUnit } from '../../state/joints/length-unit.ts';
import { onShown } from '../../state/shown-comparison.ts';
import type { Uses } from '../../state/workbench.ts';
import { errorSize } from '../../widgets/numbers/number-text.ts';
import { scaleText as partText } from '../skin/four-text.ts';
import { type ComparedPart, comparedParts, errorsOfSkin, fillHeat, heatTop, tellsOwn, theirJoints } from './drawn.ts';
import { type Places, sphereAround, viewOf } from './frame-both.ts';
import { CompareLegend, type ScaleText } from './legend.ts';

/** Error of the brightest colour, and the worst vertex. */
interface HeatScale {
  readonly top: number;
  readonly worst: number | undefined;
}

type Parts = Uses<'store' | 'viewport' | 'transport' | 'settings' | 'comparing'>;

/** While playing, times this many frames apart are drawn as a motion; those further apart would only flash. */
const MAX_FRAMES_APART = 2;

/** Draws until it is called. @param stage gets the legend */
export function drawComparisons(wb: Parts, stage: HTMLElement): () => void {
  const drawing = new ComparisonDrawing(wb, stage);
  return () => drawing.end();
}

class ComparisonDrawing {
  private side: ComparedSide = 'both';
  /** Chosen by the user; undefined: what has the first wrong item. */
  private chosenPart: ComparedPart | undefined;
  private shown: ShownComparison | undefined;
  private character: Character | undefined;
  private overlay: CompareOverlay | undefined;
  private removeOverlay: (() => void) | undefined;
  private look: Look | undefined;
  /** Parts of the largest error, as drawn; and an array for the next ones. */
  private heat = new Float32Array(0);
  private nextHeat = new Float32Array(0);
  private worst: number | undefined;
  private readonly legend: CompareLegend;
  private readonly stops: readonly (() => void)[];
  /** See `poseNow`. */
  private posedFor: Character | undefined;
  private world: Float64Array | undefined;
  private placed: readonly (Float64Array | undefined)[] = [];
  private placements = new Float64Array(0);

  constructor(
    private readonly wb: Parts,
    private readonly stage: HTMLElement,
  ) {
    this.legend = new CompareLegend({
      side: (side) => {
        this.side = side;
        this.draw();
      },
      part: (part) => {
        this.chosenPart = part;
        this.draw();
      },
      worst: () => this.selectWorst(),
      frame: () => this.frameBoth(),
    });
    this.stops = [
      onShown(wb, (shown, comparing) => {
        this.shown = shown;
        if (comparing) this.draw();
        else this.leave();
      }),
      wb.store.subscribe((now, before) => {
        if (now.document !== before.document && wb.comparing.get()?.character !== this.character) this.draw();
      }),
      wb.settings.subscribe((now, before) => {
        if (now.display.skin !== before.display.skin) this.draw();
      }),
      wb.viewport.pointing.onHover(() => this.overlay?.hover(this.hovered())),
      wb.transport.subscribe((now, before) => {
        if (now.playing !== before.playing) this.draw();
      }),
    ];
  }

  end(): void {
    for (const stop of this.stops) stop();
    this.leave();
  }

  private draw(): void {
    const { wb, shown } = this;
    const character = wb.comparing.get()?.character;
    this.character = character;
    const parts = shown && character && this.isSteady(shown.result) ? comparedParts(shown) : [];
    if (!shown || !character || parts.length === 0) {
      this.overlay?.show(undefined);
      this.setLook(undefined);
      this.legend.element.remove();
      return;
    }
    const part = parts.find((name) => name === this.chosenPart) ?? parts[0];
    const scale = part === 'skin' ? this.fillErrors(shown) : undefined;
    this.worst = scale?.worst;
    this.ready().show(this.drawingOf(character, shown, scale));
    this.setLook(this.lookOf(character, part));
    this.legend.show({
      side: this.side,
      part,
      parts,
      tellsOwn: tellsOwn(shown),
      ...(scale && { scale: scaleText(character, shown, scale) }),
    });
    if (!this.legend.element.isConnected) this.stage.append(this.legend.element);
    wb.viewport.requestRender();
  }

  private leave(): void {
    this.chosenPart = undefined;
    this.setLook(undefined);
    this.removeOverlay?.();
    this.removeOverlay = this.overlay = undefined;
    this.legend.element.remove();
    this.heat = this.nextHeat = new Float32Array(0);
    this.posedFor = this.world = undefined;
    this.placed = [];
  }

  private ready(): CompareOverlay {
    if (!this.overlay) {
      this.overlay = new CompareOverlay(() => this.poseNow());
      this.removeOverlay = this.wb.viewport.addOverlay(this.overlay);
    }
    return this.overlay;
  }

  /** Whether it is drawn while playing. */
  private isSteady({ comparison }: ComparedResult): boolean {
    const { playing, framesPerSecond } = this.wb.transport.get();
    if (!playing) return true;
    const times = comparison.frames.flatMap(({ time }) => time ?? []);
    const span = Math.max(...times) - Math.min(...times);
    return times.length > 1 && span / (times.length - 1) <= MAX_FRAMES_APART / framesPerSecond;
  }

  private fillErrors(shown: ShownComparison): HeatScale {
    const all = errorsOfSkin(shown.frame);
    const next = this.nextHeat.length === all.length ? this.nextHeat : new Float32Array(all.length);
    this.nextHeat = this.heat;
    this.heat = next;
    const top = heatTop(shown);
    return { top, worst: fillHeat(all, shown.result.tolerance, top, next) };
  }

  private drawingOf(character: Character, shown: ShownComparison, scale: HeatScale | undefined): ComparedDrawing {
    const { side, heat: errors } = this;
    const { skeleton } = character;
    const base = { placementCount: character.placements.length, side };
    const skin = shownSkin(character);
    if (scale) {
      const { ours } = shown.frame;
      const worst = ours.vertices.length > 0 ? scale.worst : undefined;
      return {
        ...base,
        ...(skin && { vertices: { skin, ours: ours.vertices, theirs: shown.theirs.vertices, errors, worst } }),
      };
    }
    const theirs = skeleton && theirJoints(skeleton, shown);
    if (!theirs) return base;
    const { world: ours } = shown.frame.ours;
    const { tolerance } = shown.result;
    const verdicts = jointMarks(shown.frame, tolerance);
    return { ...base, joints: { skeleton, verdicts, ours, theirs, tolerance: tolerance * shown.frame.size } };
  }

  private lookOf({ id }: Character, part: ComparedPart): Look {
    const { side, heat } = this;
    const { skin } = this.wb.settings.get().display;
    if (part === 'joints') return { characterId: id, skin: isOpaque(skin) ? 'xray' : skin, bones: side !== 'theirs' };
    const isHidden = side === 'theirs' && this.shown?.theirs.vertices !== undefined;
    return { characterId: id, skin: isHidden ? 'hidden' : 'heat', bones: false, heat };
  }

  private setLook(look: Look | undefined): void {
    const { look: before } = this;
    const isSame =
      look?.characterId === before?.characterId &&
      look?.skin === before?.skin &&
      look?.bones === before?.bones &&
      look?.heat === before?.heat;
    if (isSame) return;
    this.look = look;
    this.wb.viewport.setLook(look);
  }

  /** Copies what the viewport is about to draw. Its arrays stay the same until the character is edited. */
  private readonly poseNow = () => {
    const { character, wb } = this;
    if (!character) return undefined;
    if (this.posedFor !== character) {
      this.posedFor = character;
      this.world = wb.viewport.character(character.id)?.worlds;
      this.placed = character.placements.map((_, p) => wb.viewport.placementOf(character.id, p));
      this.placements = new Float64Array(16 * this.placed.length);
    }
    const { world, placed, placements, pose } = this;
    for (let p = 0; p < placed.length; p++) {
      const own = placed[p];
      // A hidden character.
      if (!own) return undefined;
      placements.set(own, 16 * p);
    }
    if (!world) return undefined;
    pose.world = world;
    pose.placements = placements;
    return pose;
  };
  private readonly pose: { world: Float64Array; placements: Float64Array } = {
    world: this.placements,
    placements: this.placements,
  };

  private hovered() {
    const { hovered } = this.wb.viewport.pointing;
    return hovered?.characterId === this.character?.id ? hovered : undefined;
  }

  private frameBoth(): void {
    const { shown, character, wb } = this;
    const placements = this.poseNow()?.placements;
    if (!shown || !character || !placements) return;
    const { theirs, frame } = shown;
    const points = (numbers: Float64Array): Places => ({ numbers, stride: 3, first: 0 });
    const origins = (numbers: Float64Array): Places => ({ numbers, stride: 16, first: 12 });
    const joints = character.skeleton && theirJoints(character.skeleton, shown);
    const places = [
      origins(frame.ours.world),
      points(frame.ours.vertices),
      ...(theirs.vertices ? [points(theirs.vertices)] : []),
      ...(joints ? [joints === theirs.positions ? points(joints) : origins(joints)] : []),
    ];
    const sphere = sphereAround(places, placements);
    if (!sphere) return;
    const { viewport } = wb;
    const { clientWidth, clientHeight } = viewport.canvas;
    const view = viewport.camera.view;
    const across = viewport.eye.unitsPerPixel(view.target) * Math.min(clientWidth, clientHeight);
    viewport.camera.view = viewOf(sphere, view, across);
  }

  private selectWorst(): void {
    const { character, worst, wb } = this;
    if (character && worst !== undefined) wb.store.select({ characterId: character.id, vertex: worst });
  }
}

function scaleText(character: Character, { frame }: ShownComparison, { top, worst }: HeatScale): ScaleText {
  const isOfLength = frame.vertexErrors.length > 0;
  const lengthOf = (error: number) => `${errorSize(error * frame.size)} ${lengthUnit(character)}`;
  const text = isOfLength ? lengthOf : errorSize;
  const largest = worst === undefined ? undefined : errorsOfSkin(frame)[worst];
  return {
    title: isOfLength ? 'Error of vertices' : 'Error of normals',
    explanation: `Largest difference in x, y or z of each vertex${isOfLength ? '' : '’s normal'}`,
    top: isOfLength ? `${text(top)}, ${partText(top)}` : text(top),
    worst:
      largest === undefined ? '' : `Worst: vertex ${worst}, ${Number.isFinite(largest) ? text(largest) : 'no number'}`,
  };
}
