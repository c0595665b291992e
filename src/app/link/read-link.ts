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
import { DISPLAY_WORDS, displayOfWords } from '../../model/display-words.ts';
import type { Display } from '../../model/session.ts';
import { THEMES } from '../../ui/state/settings.ts';
import { TIMELINE_TABS, type TimelineTabName } from '../../ui/state/timeline.ts';
import type { CameraView } from '../../view/camera/camera.ts';
import { numbersIn, viewOf } from '../../view/camera/view-numbers.ts';

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
  const [time] = read('time', 'seconds', (text) => numbersIn(text, 1)) ?? [];
  const range = read('range', 'two times, the first before the second', (text) => {
    const all = numbersIn(text, 2);
    return all && all[0] < all[1] ? ([all[0], all[1]] as const) : undefined;
  });
  const plays = oneOf('play', ['0', '1']);
  const camera = read('camera', 'six numbers: the position, and another one that it looks at', (text) =>
    viewOf(numbersIn(text, 6)),
  );
  const display = read('show', DISPLAY_WORDS.join(', '), displayOfWords);
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
