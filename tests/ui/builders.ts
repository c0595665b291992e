/** Small documents and a workbench without a page, for the tests of `ui`. */
import { DEFAULT_PLAYBACK, type Playback } from '../../src/edit/playback.ts';
import { Store } from '../../src/edit/store.ts';
import { type Character, DEFAULT_PLACEMENT, type Document, EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import {
  DEFAULT_BOX,
  DEFAULT_MOTION,
  type Joint,
  type Skeleton,
  UNLIMITED,
} from '../../src/model/skeleton/skeleton.ts';
import type { Samples } from '../../src/model/takes/samples.ts';
import { type Channel, type KeyedChannel, SAMPLED, type Take } from '../../src/model/takes/take.ts';
import { pageActions } from '../../src/ui/shell/actions.ts';
import { PageActions } from '../../src/ui/state/actions/page-actions.ts';
import type { DumpComparison } from '../../src/ui/state/dump-comparison.ts';
import type { GuideName } from '../../src/ui/state/guide.ts';
import type { KeptOffer } from '../../src/ui/state/kept-offer.ts';
import type { AskedManual } from '../../src/ui/state/manual-link.ts';
import { Messages } from '../../src/ui/state/messages.ts';
import { NOT_OFFLINE, type Offline } from '../../src/ui/state/offline.ts';
import { Posing } from '../../src/ui/state/posing.ts';
import { DEFAULT_SETTINGS } from '../../src/ui/state/settings.ts';
import { Timeline } from '../../src/ui/state/timeline.ts';
import type { DialogName, Loading, Workbench } from '../../src/ui/state/workbench.ts';
import { observable } from '../../src/ui/widgets/observable.ts';

export function joint(name: string, parent: number): Joint {
  return {
    name,
    parent,
    offset: [0, 1, 0],
    box: DEFAULT_BOX,
    motion: DEFAULT_MOTION,
    limits: [UNLIMITED, UNLIMITED, UNLIMITED],
    pose: [0, 0, 0],
  };
}

/** `['hips', -1]`, `['leg', 0]` … in depth-first order. */
export function skeleton(...joints: readonly (readonly [string, number])[]): Skeleton {
  return { name: 'test', joints: joints.map(([name, parent]) => joint(name, parent)) };
}

export function channel(...times: number[]): KeyedChannel {
  const column = () => ({ kinds: new Uint8Array(times.length), slopes: new Float64Array(times.length) });
  return {
    kind: 'keys',
    extrapolateIn: 'constant',
    extrapolateOut: 'constant',
    times: Float64Array.from(times),
    values: new Float64Array(times.length),
    tangentsIn: column(),
    tangentsOut: column(),
  };
}

export function take(range: readonly [number, number], ...channels: Channel[]): Take {
  return { name: 'walk', range, channels };
}

/** A take of samples: in channel `c` of frame `f` the value is `value(f, c)`, by default 0. */
export function capture(
  channels: number,
  frameSeconds: number,
  frameCount: number,
  value: (frame: number, channel: number) => number = () => 0,
): Take {
  const samples: Samples = {
    frameCount,
    frameSeconds,
    startSeconds: 0,
    firstChannel: 0,
    values: Float64Array.from({ length: frameCount * channels }, (_, i) =>
      value(Math.floor(i / channels), i % channels),
    ),
    scales: new Float64Array(channels).fill(1),
    interpolation: 'linear',
  };
  const range = [0, (frameCount - 1) * frameSeconds] as const;
  return { name: 'take', range, channels: Array.from({ length: channels }, () => SAMPLED), samples };
}

export function character(change: Partial<Character> = {}): Character {
  const base: Character = {
    id: 'c1',
    name: 'wasp',
    skins: [],
    shownSkin: 0,
    morphs: [],
    textures: [],
    takes: [],
    shownTake: 0,
    pose: filePose(change.skeleton, change.morphs?.length ?? 0),
    clampsToLimits: true,
    placements: [DEFAULT_PLACEMENT],
    timeOffsetSeconds: 0,
    sources: [],
  };
  return { ...base, ...change };
}

export function documentOf(...characters: Character[]): Document {
  return { ...EMPTY_DOCUMENT, characters };
}

/** Records calls to the viewport instead of drawing. */
export function workbench(document: Document = EMPTY_DOCUMENT, playback: Partial<Playback> = {}) {
  const seeks: number[] = [];
  const saved: string[] = [];
  const revealed: string[] = [];
  const floors: number[] = [];
  const viewport = {
    seek: (seconds: number) => void seeks.push(seconds),
    setFloor: (y: number) => void floors.push(y),
    show: () => {},
    camera: {
      frameAll: () => {},
      frameSelection: () => {},
      reveal: (id: string) => void revealed.push(id),
      lookFrom: () => {},
      turn: () => {},
      turnCharacter: () => {},
    },
    pointing: { pick: () => undefined },
    setTheme: () => {},
    character: () => undefined,
    freezeRootMotion: () => () => {},
    withDrawnSkin: () => undefined,
  };
  // The canvas and its element need a browser, and no test uses them.
  const wb: Workbench = {
    actions: new PageActions(
      () => pageActions(wb),
      () => wb,
    ),
    store: new Store(document),
    transport: observable<Playback>({ ...DEFAULT_PLAYBACK, ...playback }),
    timeline: new Timeline(),
    posing: new Posing(),
    settings: observable(DEFAULT_SETTINGS),
    messages: new Messages(),
    loading: observable<Loading | undefined>(undefined),
    dialog: observable<DialogName | undefined>(undefined),
    kept: observable<KeptOffer | undefined>(undefined),
    offline: observable<Offline>(NOT_OFFLINE),
    comparing: observable<DumpComparison | undefined>(undefined),
    guide: observable<GuideName | undefined>(undefined),
    manual: observable<AskedManual | undefined>(undefined),
    files: {
      open: () => {},
      openSample: () => {},
      saveKit: () => {},
      samples: [{ id: 'walker', label: 'Walker', description: 'walks' }],
      drop: () => {},
      paste: () => {},
      canReload: () => false,
      save: (id: string, kind: string) => void saved.push(`${id}.${kind}`),
    },
    viewport,
  } as unknown as Workbench;
  return { wb, seeks, saved, revealed, floors };
}
