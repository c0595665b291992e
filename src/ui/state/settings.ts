/**
 * What the page remembers between visits: how things are drawn, units, panels, keys. Kept as one JSON text in
 * localStorage. A store that is forbidden, full, or holds something else than we wrote only means defaults: nobody
 * should be locked out of the page by what an older version left there.
 */
import { DEFAULT_DISPLAY, type Display, GHOST_UNITS, MAX_GHOSTS } from '../../model/session.ts';
import { type Observable, observable } from '../kit/observable.ts';

export const THEMES = ['system', 'light', 'dark'] as const;
export const ANGLES = ['degrees', 'radians'] as const;
export const NEW_KEY_TANGENTS = ['smooth', 'linear', 'flat'] as const;
export const TIME_DISPLAYS = ['seconds', 'frames'] as const;

export interface Settings {
  readonly display: Display;
  readonly theme: (typeof THEMES)[number];
  readonly angles: (typeof ANGLES)[number];
  readonly timeDisplay: (typeof TIME_DISPLAYS)[number];
  readonly panels: Panels;
  /** Of keys made by keying; on both sides. */
  readonly newKeyTangents: (typeof NEW_KEY_TANGENTS)[number];
  /** Folders of the inspector and groups of the outliner that were folded or unfolded by hand: true is open. */
  readonly folds: Readonly<Record<string, boolean>>;
  /** Shortcuts without Ctrl, Cmd or Alt; some people's speech input or switches can't live with them. */
  readonly singleKeys: boolean;
  /** Keys of an action that were changed, by its id; an empty list switches it off. */
  readonly keys: Readonly<Record<string, readonly string[]>>;
}

export interface Panels {
  /** Pixels. */
  readonly outlinerWidth: number;
  readonly inspectorWidth: number;
  /** Of the files and messages below the tree; 0 until it is chosen: what leaves the tree the most. */
  readonly filesHeight: number;
  /** 0 until it is chosen: what suits the window. */
  readonly timelineHeight: number;
  readonly outlinerOpen: boolean;
  readonly inspectorOpen: boolean;
  readonly timelineOpen: boolean;
  /** The one that is open on a narrow page; not remembered. */
  readonly drawer: 'none' | 'outliner' | 'inspector';
}

export const DEFAULT_SETTINGS: Settings = {
  display: DEFAULT_DISPLAY,
  theme: 'system',
  angles: 'degrees',
  timeDisplay: 'seconds',
  panels: {
    outlinerWidth: 240,
    inspectorWidth: 312,
    filesHeight: 0,
    timelineHeight: 0,
    outlinerOpen: true,
    inspectorOpen: true,
    timelineOpen: true,
    drawer: 'none',
  },
  newKeyTangents: 'smooth',
  folds: {},
  singleKeys: true,
  keys: {},
};

const KEY = 'marrow.settings';
/** Writing waits this long, so that a drag of a splitter is one write. */
const WRITE_DELAY_MS = 250;

/**
 * The settings that were kept, and every later change kept too.
 * @param kept what of them is to be remembered
 */
export function rememberedSettings(
  storage: () => Storage,
  kept: (settings: Settings) => Settings = (settings) => settings,
): Observable<Settings> {
  const settings = observable(parseSettings(read(storage)));
  let timer: ReturnType<typeof setTimeout> | undefined;
  const write = () => {
    timer = undefined;
    try {
      storage().setItem(KEY, JSON.stringify(kept(settings.get())));
    } catch {
      // Forbidden or full: this visit goes on without memory.
    }
  };
  settings.subscribe(() => {
    if (timer === undefined) timer = setTimeout(write, WRITE_DELAY_MS);
  });
  return settings;
}

/** Settings from a text that may be anything: each part that has the right shape is taken, the rest is the default. */
export function parseSettings(text: string | null): Settings {
  const kept = asRecord(parseJson(text));
  const d = DEFAULT_SETTINGS;
  const singleKeys = kept.singleKeys;
  return {
    display: parseDisplay(asRecord(kept.display)),
    theme: oneOf(THEMES, kept.theme, d.theme),
    angles: oneOf(ANGLES, kept.angles, d.angles),
    timeDisplay: oneOf(TIME_DISPLAYS, kept.timeDisplay, d.timeDisplay),
    panels: { ...sameTypes(d.panels, asRecord(kept.panels)), drawer: d.panels.drawer },
    newKeyTangents: oneOf(NEW_KEY_TANGENTS, kept.newKeyTangents, d.newKeyTangents),
    folds: Object.fromEntries(Object.entries(asRecord(kept.folds)).filter(isFold)),
    singleKeys: typeof singleKeys === 'boolean' ? singleKeys : d.singleKeys,
    keys: Object.fromEntries(Object.entries(asRecord(kept.keys)).filter(isKeys)),
  };
}

const SKINS = ['hidden', 'solid', 'textured', 'wire', 'xray', 'heat'] as const;
const BOXES = ['hidden', 'bare', 'wire', 'solid'] as const;

function parseDisplay(kept: Record<string, unknown>): Display {
  const display = sameTypes(DEFAULT_DISPLAY, kept);
  return {
    ...display,
    skin: oneOf(SKINS, kept.skin, DEFAULT_DISPLAY.skin),
    boxes: oneOf(BOXES, kept.boxes, DEFAULT_DISPLAY.boxes),
    ghostsBefore: count(kept.ghostsBefore, DEFAULT_DISPLAY.ghostsBefore),
    ghostsAfter: count(kept.ghostsAfter, DEFAULT_DISPLAY.ghostsAfter),
    ghostStepIn: oneOf(GHOST_UNITS, kept.ghostStepIn, DEFAULT_DISPLAY.ghostStepIn),
    // A camera that follows from the first moment on looks like a fault.
    follow: DEFAULT_DISPLAY.follow,
  };
}

/** How many ghosts. */
function count(kept: unknown, otherwise: number): number {
  const fits = typeof kept === 'number' && Number.isInteger(kept) && kept >= 0 && kept <= MAX_GHOSTS;
  return fits ? kept : otherwise;
}

/** `defaults`, with what `kept` has of the same type. Sizes have to be sensible numbers. */
function sameTypes<T extends object>(defaults: T, kept: Record<string, unknown>): T {
  const result: Record<string, unknown> = Object.fromEntries(Object.entries(defaults));
  for (const [key, value] of Object.entries(defaults)) {
    const found = kept[key];
    if (typeof found !== typeof value) continue;
    if (typeof found === 'number' && !(found >= 0 && found <= 4096)) continue;
    result[key] = found;
  }
  // The keys are those of `defaults`, and each value has its type.
  return result as T;
}

function oneOf<T extends string>(allowed: readonly T[], value: unknown, otherwise: T): T {
  return allowed.find((a) => a === value) ?? otherwise;
}

function isFold(entry: [string, unknown]): entry is [string, boolean] {
  return typeof entry[1] === 'boolean';
}

function isKeys(entry: [string, unknown]): entry is [string, string[]] {
  return Array.isArray(entry[1]) && entry[1].every((key) => typeof key === 'string');
}

function asRecord(value: unknown): Record<string, unknown> {
  // Narrowed to an object that is no list; what its fields are is looked at one by one.
  return typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Record<string, unknown>) : {};
}

function parseJson(text: string | null): unknown {
  try {
    return text === null ? undefined : JSON.parse(text);
  } catch {
    return undefined;
  }
}

function read(storage: () => Storage): string | null {
  try {
    return storage().getItem(KEY);
  } catch {
    return null;
  }
}
