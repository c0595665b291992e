/**
 * What is kept of a page's work: everything that someone would have to redo. The undo history is left out, since it may
 * be many times the document's size; display and panels are remembered for all pages together (`ui/state/settings.ts`).
 */
import type { Playback } from '../../edit/playback.ts';
import type { SavedCharacter } from '../../files/save/saved-parts.ts';
import type { CardCharacter, SessionCard } from '../../io/session-store.ts';
import type { Document } from '../../model/document.ts';
import type { Selection } from '../../model/session.ts';
import type { ReviewedTake } from '../../model/takes/review.ts';
import type { TimelineView } from '../../ui/state/timeline.ts';
import type { CameraView } from '../../view/camera/camera.ts';
import type { KnownSkin } from '../../worker/protocol.ts';
import type { KeptDiskFile } from '../disk-handles.ts';

export interface SessionState {
  readonly document: Document;
  readonly selection: Selection;
  readonly transport: Playback;
  readonly timeline: TimelineView;
  readonly camera: CameraView;
  /** State of saving: which parts differ from their files, and where those are. Plain data. */
  readonly saving?: unknown;
}

/** State of saving: which parts differ from their files, and where those are. */
export interface KeptMarks {
  readonly saved: readonly SavedCharacter[];
  readonly disk: readonly KeptDiskFile[];
  /** What the last list says of takes in review. */
  readonly review?: readonly ReviewedTake[];
}

/** What is written: the state, and what would take long to compute again. */
export interface KeptState extends SessionState {
  readonly knownSkins: readonly KnownSkin[];
}

/** Version of the records' format, with everything in them; others are left to the pages that wrote them. */
export const SESSION_VERSION = 4;

export function cardOf(id: string, { document }: SessionState, savedAtMs: number): SessionCard {
  const characters = document.characters.map(
    ({ name, skeleton, takes }): CardCharacter => ({
      name,
      joints: skeleton?.joints.length ?? 0,
      takes: takes.length,
    }),
  );
  return { id, version: SESSION_VERSION, savedAtMs, characters };
}

/**
 * Whether nothing has to be saved. Time alone is ignored while playing; changes of `saving` are reported separately.
 */
export function isSameState(a: SessionState, b: SessionState): boolean {
  return (
    a.document === b.document &&
    a.selection === b.selection &&
    a.timeline === b.timeline &&
    sameNumbers(a.camera, b.camera) &&
    samePlayback(a.transport, b.transport)
  );
}

function samePlayback(a: Playback, b: Playback): boolean {
  return (
    ((a.timeSeconds === b.timeSeconds && a.turned === b.turned) || (a.playing && b.playing)) &&
    a.playing === b.playing &&
    a.range[0] === b.range[0] &&
    a.range[1] === b.range[1] &&
    a.loop === b.loop &&
    a.rate === b.rate &&
    a.framesPerSecond === b.framesPerSecond
  );
}

function sameNumbers(a: CameraView, b: CameraView): boolean {
  return (
    a.azimuth === b.azimuth &&
    a.polar === b.polar &&
    a.distance === b.distance &&
    a.target.every((value, axis) => value === b.target[axis])
  );
}
