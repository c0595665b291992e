/**
 * What the page remembers between visits: display, units, panels, shortcuts. Stored as one JSON text in localStorage.
 * If storage is forbidden, full or has unexpected content, defaults are used: an older version's data must never lock
 * anyone out.
 */
import { DEFAULT_DISPLAY, type Display, GHOST_SHAPES, GHOST_UNITS, MAX_GHOSTS } from '../../model/session.ts';
import { NEW_KEY_TANGENTS, type NewKeyTangents } from '../../model/takes/tangent-kinds.ts';
import { type Observable, observable } from '../widgets/observable.ts';

export const THEMES = ['system', 'light', 'dark'] as const;
export const ANGLES = ['degrees', 'radians'] as const;
/** Smallest and largest. */
export const GIZMO_SCALES = [0.5, 2] as const;
/** What bends with a dragged joint; `usual` until one was chosen: what is usual for the form of the skeleton. */
export const IK_REACHES = ['usual', 'limb', 'body', 'chain'] as const;
export const TIME_DISPLAYS = ['seconds', 'frames'] as const;

export interface Settings {
  readonly display: Display;
  readonly theme: (typeof THEMES)[number];
  readonly angles: (typeof ANGLES)[number];
  readonly timeDisplay: (typeof TIME_DISPLAYS)[number];
  readonly panels: Panels;
  /** Tangents of new keys, on both sides. */
  readonly newKeyTangents: NewKeyTangents;
  /** Factor of the size of the viewport's gizmo, within `GIZMO_SCALES`. */
  readonly gizmoScale: number;
  readonly ikReach: (typeof IK_REACHES)[number];
  /** Whether joints and boxes snap to the grid in rig mode, unless Shift is held. */
  readonly snapsToGrid: boolean;
  /** What the tab *Measure* plots, by its own names; unknown ones are its defaults. */
  readonly measured: { readonly quantity: string; readonly subject: string };
  /** Sections of the inspector and groups of the outliner that the user has expanded (true) or collapsed. */
  readonly folds: Readonly<Record<string, boolean>>;
  /** Megabytes that undo may keep; 0: what the browser gives decides (`shell/undo-memory.ts`). */
  readonly undoMegabytes: number;
  /** Whether shortcuts without Ctrl, Cmd or Alt are enabled; speech input and switch devices may conflict with them. */
  readonly singleKeys: boolean;
  /** The hint for newcomers, until it was followed or closed. */
  readonly firstSteps: boolean;
  /** Remapped shortcuts by action id; an empty list removes them. */
  readonly keys: Readonly<Record<string, readonly string[]>>;
}

export interface Panels {
  /** Pixels. */
  readonly outlinerWidth: number;
  readonly inspectorWidth: number;
  /** Height of files and messages below the tree; 0: the default, which leaves the tree most room. */
  readonly filesHeight: number;
  /** 0: a default that depends on the window. */
  readonly timelineHeight: number;
  /** Height of the dope sheet above the curves; 0: a part of theirs. */
  readonly dopeHeight: number;
  readonly outlinerOpen: boolean;
  readonly inspectorOpen: boolean;
  readonly timelineOpen: boolean;
  /** The open side drawer on a narrow page; not remembered. */
  readonly drawer: 'none' | 'outliner' | 'inspector';
  /** Whether the timeline is open on a narrow page; not remembered. */
  readonly timelineDrawer: boolean;
}

export const DEFAULT_SETTINGS: Settings = {
  display: DEFAULT_DISPLAY,
  theme: 'system',
  angles: 'degrees',
  timeDisplay: 'seconds',
  panels: {
    outlinerWidth: 216,
    inspectorWidth: 244,
    filesHeight: 0,
    timelineHeight: 0,
    dopeHeight: 0,
    outlinerOpen: true,
    inspectorOpen: true,
    timelineOpen: false,
    drawer: 'none',
    timelineDrawer: false,
  },
  newKeyTangents: 'smooth',
  gizmoScale: 1,
  ikReach: 'usual',
  snapsToGrid: true,
  undoMegabytes: 0,
  measured: { quantity: 'speed', subject: 'joints' },
  folds: {},
  singleKeys: true,
  firstSteps: true,
  keys: {},
};

const KEY = 'marrow.settings';
/** Debounces writing, so that dragging a splitter is one write. */
const WRITE_DELAY_MS = 250;

/**
 * The stored settings, with every later change stored too.
 *
 * @param storage undefined: nothing is stored
 * @param kept the part of them to be stored
 */
export function rememberedSettings(
  storage: () => Storage | undefined,
  kept: (settings: Settings) => Settings = (settings) => settings,
): Observable<Settings> {
  const settings = observable(parseSettings(read(storage)));
  let timer: ReturnType<typeof setTimeout> | undefined;
  const write = () => {
    timer = undefined;
    try {
      storage()?.setItem(KEY, JSON.stringify(kept(settings.get())));
    } catch {
      // Forbidden or full: this visit isn't remembered.
    }
  };
  settings.subscribe(() => {
    if (timer === undefined) timer = setTimeout(write, WRITE_DELAY_MS);
  });
  return settings;
}

/** Parses settings from any text: parts of the right shape are used, the rest are defaults. */
export function parseSettings(text: string | null): Settings {
  const kept = asRecord(parseJson(text));
  const d = DEFAULT_SETTINGS;
  const singleKeys = kept.singleKeys;
  return {
    display: parseDisplay(asRecord(kept.display)),
    theme: oneOf(THEMES, kept.theme, d.theme),
    angles: oneOf(ANGLES, kept.angles, d.angles),
    timeDisplay: oneOf(TIME_DISPLAYS, kept.timeDisplay, d.timeDisplay),
    panels: { ...sameTypes(d.panels, asRecord(kept.panels)), drawer: d.panels.drawer, timelineDrawer: false },
    newKeyTangents: oneOf(NEW_KEY_TANGENTS, kept.newKeyTangents, d.newKeyTangents),
    gizmoScale: within(GIZMO_SCALES, kept.gizmoScale, d.gizmoScale),
    ikReach: oneOf(IK_REACHES, kept.ikReach, d.ikReach),
    snapsToGrid: typeof kept.snapsToGrid === 'boolean' ? kept.snapsToGrid : d.snapsToGrid,
    undoMegabytes: within([0, 1e5], kept.undoMegabytes, d.undoMegabytes),
    measured: sameTypes(d.measured, asRecord(kept.measured)),
    folds: Object.fromEntries(Object.entries(asRecord(kept.folds)).filter(isFold)),
    singleKeys: typeof singleKeys === 'boolean' ? singleKeys : d.singleKeys,
    firstSteps: typeof kept.firstSteps === 'boolean' ? kept.firstSteps : d.firstSteps,
    keys: Object.fromEntries(Object.entries(asRecord(kept.keys)).filter(isKeys)),
  };
}

const SKINS = ['hidden', 'solid', 'textured', 'wire', 'xray', 'heat', 'four'] as const;
const BOXES = ['hidden', 'bare', 'wire', 'solid'] as const;

function parseDisplay(kept: Record<string, unknown>): Display {
  const display = sameTypes(DEFAULT_DISPLAY, kept);
  return {
    ...display,
    skin: oneOf(SKINS, kept.skin, DEFAULT_DISPLAY.skin),
    boxes: oneOf(BOXES, kept.boxes, DEFAULT_DISPLAY.boxes),
    boneThickness: Math.min(4, Math.max(0.25, display.boneThickness)),
    ghostsBefore: count(kept.ghostsBefore, DEFAULT_DISPLAY.ghostsBefore),
    ghostsAfter: count(kept.ghostsAfter, DEFAULT_DISPLAY.ghostsAfter),
    ghostStepIn: oneOf(GHOST_UNITS, kept.ghostStepIn, DEFAULT_DISPLAY.ghostStepIn),
    ghostsOf: oneOf(GHOST_SHAPES, kept.ghostsOf, DEFAULT_DISPLAY.ghostsOf),
    // Not remembered: a camera that follows from the start looks like a fault.
    follow: DEFAULT_DISPLAY.follow,
    followRoot: DEFAULT_DISPLAY.followRoot,
    // Likewise a motion that jumps.
    stepped: DEFAULT_DISPLAY.stepped,
  };
}

/** A number of ghosts. */
function count(kept: unknown, otherwise: number): number {
  const fits = typeof kept === 'number' && Number.isInteger(kept) && kept >= 0 && kept <= MAX_GHOSTS;
  return fits ? kept : otherwise;
}

/** `defaults`, overridden by fields of `kept` with the same type. Sizes must be sensible numbers. */
function sameTypes<T extends object>(defaults: T, kept: Record<string, unknown>): T {
  const result: Record<string, unknown> = Object.fromEntries(Object.entries(defaults));
  for (const [key, value] of Object.entries(defaults)) {
    const found = kept[key];
    if (typeof found !== typeof value) continue;
    if (typeof found === 'number' && !(found >= 0 && found <= 4096)) continue;
    result[key] = found;
  }
  // Has the keys of `defaults`, each with its type.
  return result as T;
}

function oneOf<T extends string>(allowed: readonly T[], value: unknown, otherwise: T): T {
  return allowed.find((a) => a === value) ?? otherwise;
}

function within([min, max]: readonly [number, number], value: unknown, otherwise: number): number {
  return typeof value === 'number' && value >= min && value <= max ? value : otherwise;
}

function isFold(entry: [string, unknown]): entry is [string, boolean] {
  return typeof entry[1] === 'boolean';
}

function isKeys(entry: [string, unknown]): entry is [string, string[]] {
  return Array.isArray(entry[1]) && entry[1].every((key) => typeof key === 'string');
}

function asRecord(value: unknown): Record<string, unknown> {
  // Narrowed to a non-array object; its fields are checked one by one.
  return typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Record<string, unknown>) : {};
}

function parseJson(text: string | null): unknown {
  try {
    return text === null ? undefined : JSON.parse(text);
  } catch {
    return undefined;
  }
}

function read(storage: () => Storage | undefined): string | null {
  try {
    return storage()?.getItem(KEY) ?? null;
  } catch {
    return null;
  }
}
