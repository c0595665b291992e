/**
 * What an address asks for beside files: `?sample=walker&take=walk&time=1.25&camera=…`. Everything in it is checked:
 * what can't be is told in one message, and the rest is done.
 *
 *     files=a.skel,a.skin      what is fetched; see `io/address.ts`
 *     sample=walker            an example, by its id
 *     take=walk,wave           takes to show, by name, of whichever characters have them
 *     time=1.25  play=0|1      seconds; a link with a time is paused there, unless it says play=1
 *     range=0,2                the playback range
 *     select=hand_l            a joint
 *     camera=x,y,z,tx,ty,tz    where the camera is and what it looks at, in the scene: metres, y up
 *     show=skin,names          what is drawn: a style of skins and of boxes, and switches
 *     panel=curves             a tab of the timeline
 *     theme=light|dark
 */
import { DEFAULT_DISPLAY, type Display } from '../../model/session.ts';
import { THEMES } from '../../ui/state/settings.ts';
import { TIMELINE_TABS, type TimelineTabName } from '../../ui/state/timeline.ts';
import type { CameraView } from '../../view/camera/camera.ts';

/** What a link asks for; what it doesn't say is absent. */
export interface Link {
  readonly sample?: string;
  readonly takes: readonly string[];
  readonly time?: number;
  readonly plays?: boolean;
  readonly range?: readonly [number, number];
  readonly joint?: string;
  readonly camera?: CameraView;
  readonly display?: Partial<Display>;
  readonly panel?: TimelineTabName;
  readonly theme?: (typeof THEMES)[number];
  /** What is wrong with it, as parts of a sentence. */
  readonly wrong: readonly string[];
}

/** Each word of `show`, and what it changes; of skins and boxes, the first is what `skin` and `boxes` mean. */
const WORDS: ReadonlyMap<string, Partial<Display>> = new Map<string, Partial<Display>>([
  ['nothing', {}],
  ['skin', { skin: 'textured' }],
  ...(['solid', 'wire', 'xray', 'heat', 'four'] as const).map((skin) => [skin, { skin }] as const),
  ['boxes', { boxes: 'solid' }],
  ['bare-boxes', { boxes: 'bare' }],
  ['wire-boxes', { boxes: 'wire' }],
  ['bones', { bones: true }],
  ['axes', { axes: true }],
  ['names', { names: true }],
  ['normals', { normals: true }],
  ['no-character-names', { characterNames: false }],
  ['no-grid', { grid: false }],
  ['no-shadow', { shadow: false }],
  ['floor-at-zero', { floorAtLowest: false }],
  ['orthographic', { orthographic: true }],
  ['path', { trail: true }],
  ['ghosts', { ghosts: true }],
  ['in-place', { inPlace: true }],
]);

/** The display with nothing of the character, and what any page has around it. */
const NOTHING: Partial<Display> = Object.fromEntries(
  [...new Set([...WORDS.values()].flatMap((patch) => Object.keys(patch)))].map((name) => [
    name,
    name === 'skin' || name === 'boxes' ? 'hidden' : DEFAULT_DISPLAY[name as keyof Display],
  ]),
);

/** The words of `show` for a display. */
export function wordsOf(display: Display): readonly string[] {
  const isSo = (patch: Partial<Display>) =>
    Object.entries(patch).every(([name, value]) => display[name as keyof Display] === value);
  const words = [...WORDS].filter(([word, patch]) => word !== 'nothing' && isSo(patch)).map(([word]) => word);
  return words.length > 0 ? words : ['nothing'];
}

/** Reads a query. Unknown parameters are passed over. */
export function readLink(query: string): Link {
  const given = new URLSearchParams(query);
  const wrong: string[] = [];
  const read = <T>(name: string, expected: string, parse: (text: string) => T | undefined): T | undefined => {
    const text = given.get(name);
    if (text === null || text === '') return undefined;
    const value = parse(text);
    if (value === undefined) wrong.push(`${name}=${text} (expected ${expected})`);
    return value;
  };
  const oneOf = <T extends string>(name: string, values: readonly T[]) =>
    read(name, values.join(', '), (text) => values.find((value) => value === text));
  const numbers = (count: number) => (text: string) => {
    const all = text.split(',').map((part) => (part.trim() === '' ? Number.NaN : Number(part)));
    return all.length === count && all.every(isUsual) ? all : undefined;
  };
  const [time] = read('time', 'seconds', numbers(1)) ?? [];
  const range = read('range', 'two times, the first before the second', (text) => {
    const all = numbers(2)(text);
    return all && all[0] < all[1] ? ([all[0], all[1]] as const) : undefined;
  });
  const plays = oneOf('play', ['0', '1']);
  const camera = read('camera', 'six numbers: the position, and another one that it looks at', (text) =>
    viewOf(numbers(6)(text)),
  );
  const display = read('show', [...WORDS.keys()].join(', '), (text) => {
    const patches = text.split(/[,|]/).map((word) => WORDS.get(word.trim()));
    return patches.every((patch) => patch !== undefined) ? Object.assign({ ...NOTHING }, ...patches) : undefined;
  });
  const panel = oneOf('panel', TIMELINE_TABS);
  const theme = oneOf('theme', THEMES);
  const sample = given.get('sample');
  const joint = given.get('select');
  return {
    takes: listIn(query, 'take'),
    wrong,
    ...(sample && { sample }),
    ...(joint && { joint }),
    ...(time !== undefined && { time }),
    ...(plays !== undefined && { plays: plays === '1' }),
    ...(range && { range }),
    ...(camera && { camera }),
    ...(display && { display }),
    ...(panel && { panel }),
    ...(theme && { theme }),
  };
}

/** Beyond it, single-precision numbers of the graphics card are no places any more. */
const FARTHEST = 1e6;

function isUsual(value: number): boolean {
  return Math.abs(value) <= FARTHEST;
}

/** Names of a list with commas between, each of which may contain encoded ones. */
function listIn(query: string, name: string): readonly string[] {
  const part = query
    .replace(/^\?/, '')
    .split('&')
    .find((one) => one.startsWith(`${name}=`));
  // Decoded one by one by the reader of queries, so that a lone % stays.
  const names = part?.slice(name.length + 1).split(',') ?? [];
  return names.flatMap((text) => new URLSearchParams(`x=${text}`).get('x') || []);
}

/** The view of a camera; undefined if it is where it looks, or straight above or below, where no side is up. */
export function viewOf(numbers: readonly number[] | undefined): CameraView | undefined {
  if (!numbers) return undefined;
  const [x, y, z, tx, ty, tz] = numbers;
  const distance = Math.hypot(x - tx, y - ty, z - tz);
  if (!(distance > 0)) return undefined;
  return {
    target: [tx, ty, tz],
    distance,
    polar: Math.acos(Math.max(-1, Math.min(1, (y - ty) / distance))),
    azimuth: Math.atan2(x - tx, z - tz),
  };
}

/** The six numbers of a view. */
export function numbersOf({ target: [tx, ty, tz], distance, polar, azimuth }: CameraView): readonly number[] {
  const flat = distance * Math.sin(polar);
  const from = [tx + flat * Math.sin(azimuth), ty + distance * Math.cos(polar), tz + flat * Math.cos(azimuth)];
  return [...from, tx, ty, tz];
}
