/** Names of the curves at their right ends, moved apart where those are close. */
import { evaluateChannel } from '../../../../evaluate/curves.ts';
import { GUTTER, timeAt } from '../../../widgets/time/time-window.ts';
import { mixed } from '../scene/colours.ts';
import { type CurveLine, type CurveScene, isFaint } from '../scene/scene.ts';
import { yOf } from '../scene/space.ts';
import type { PictureColours } from './picture-colours.ts';

const APART = 15;
/** From the right edge. */
const MARGIN = 6;
/** Of the hovered name. */
const PADDING = 4;
/** Beyond, names are in the list only: there is no room. */
const MAX_NAMES = 12;

/**
 * Heights at least `APART` from each other and within the plot, in the given order of ascending wishes; those of too
 * many names overlap at the top.
 *
 * @param wishes ascending; CSS pixels
 */
export function movedApart(wishes: readonly number[], height: number): number[] {
  const margin = APART / 2;
  const places: number[] = [];
  for (const wish of wishes) places.push(Math.max(wish, margin, (places.at(-1) ?? -APART) + APART));
  let most = height - margin;
  for (let i = places.length - 1; i >= 0; i--) {
    places[i] = Math.max(margin, Math.min(places[i], most));
    most = places[i] - APART;
  }
  return places;
}

/** `rx` where one joint is shown, else with its joint. */
function shortName({ name }: CurveLine, isAlone: boolean): string {
  return isAlone && !name.startsWith('channel ') ? name.slice(name.lastIndexOf(' ') + 1) : name;
}

interface PlacedName {
  readonly line: CurveLine;
  readonly text: string;
  /** Of its middle. */
  readonly y: number;
}

function placedNames(scene: CurveScene): readonly PlacedName[] {
  const { space, offsetSeconds, curves } = scene;
  const lines = scene.lines.filter((line) => !isFaint(scene, line));
  if (lines.length > MAX_NAMES) return [];
  const joints = new Set(lines.map(({ name }) => name.slice(0, name.lastIndexOf(' '))));
  const time = timeAt(space, space.width - GUTTER / 2) + offsetSeconds;
  const ends = lines
    .map((line) => ({ line, y: yOf(space, line, evaluateChannel(curves, line.channel, time)) }))
    .filter(({ y }) => Number.isFinite(y))
    .sort((a, b) => a.y - b.y);
  const places = movedApart(
    ends.map(({ y }) => y),
    space.height,
  );
  return ends.map(({ line }, i) => ({ line, text: shortName(line, joints.size === 1), y: places[i] }));
}

export function drawNames(g: CanvasRenderingContext2D, scene: CurveScene, colours: PictureColours): void {
  prepare(g, colours);
  g.lineJoin = 'round';
  g.lineWidth = 3;
  g.strokeStyle = colours.plot;
  for (const { line, text, y } of placedNames(scene)) {
    g.strokeText(text, scene.space.width - MARGIN, y);
    g.fillStyle = mixed(line.colour, colours.palette);
    g.fillText(text, scene.space.width - MARGIN, y);
  }
}

/** On a field of the curve's colour. */
export function drawHoveredName(
  g: CanvasRenderingContext2D,
  scene: CurveScene,
  line: CurveLine,
  colours: PictureColours,
): void {
  const placed = placedNames(scene).find((one) => one.line === line);
  if (!placed) return;
  const { text, y } = placed;
  prepare(g, colours);
  const width = g.measureText(text).width + 2 * PADDING;
  g.fillStyle = mixed(line.colour, colours.palette);
  g.beginPath();
  g.roundRect(scene.space.width - MARGIN + PADDING - width, y - APART / 2 - 1, width, APART + 2, 3);
  g.fill();
  g.fillStyle = colours.plot;
  g.fillText(text, scene.space.width - MARGIN, y);
}

function prepare(g: CanvasRenderingContext2D, colours: PictureColours): void {
  g.font = `600 ${colours.time.font}`;
  g.textAlign = 'right';
  g.textBaseline = 'middle';
}
