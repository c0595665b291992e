/**
 * Drags of keys: moving them in time (alone, with all later ones, or as copies) and scaling their times. Each is one
 * command, previewed from the document at the press: one undo step on release, none after Escape.
 */

import type { Change } from '../../../edit/change.ts';
import type { ArgsOf, Command } from '../../../edit/command.ts';
import { moveKeys, rippleKeys, scaleKeys } from '../../../edit/commands/keys.ts';
import { pasteKeys } from '../../../edit/commands/paste.ts';
import { onEachCharacter } from '../../../edit/in-turn.ts';
import { type CopiedKeys, copyKeys } from '../../../edit/keys/clipboard.ts';
import { countKeys } from '../../../edit/keys/selection.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import type { HandEdit } from '../../state/actions/hand-edit.ts';
import { addKeys } from '../../state/add-keys.ts';
import type { Uses } from '../../state/workbench.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { secondsPerPixel, timeAt } from '../../widgets/time/time-window.ts';
import { editOfTakes, keyPlacing, onAllInHand, selectedKeysInView } from '../timeline/current-take.ts';
import { copiedOfPart, rippleSeconds } from '../timeline/edit-all.ts';
import { frameNumber, snapSeconds } from '../timeline/snapping.ts';
import { type TimelineTake, timelineTake } from '../timeline/timeline-take.ts';
import type { DopeDrag, DopeHost, Pointer } from './gesture.ts';

/** Shared by moving and scaling: the original keys, and an edit that is committed or cancelled. */
abstract class KeyDrag implements DopeDrag {
  readout: string | undefined;
  protected readonly edit: HandEdit | undefined;
  protected readonly take: TimelineTake | undefined;
  protected readonly keys: readonly ChannelKeys[];
  /** From the first selected key to the last, seconds of the transport. */
  protected readonly span: readonly [number, number];

  constructor(
    protected readonly host: DopeHost,
    protected readonly from: Pointer,
  ) {
    const { wb } = host;
    this.take = timelineTake(wb);
    this.edit = this.take && editOfTakes(wb, this.take.parts);
    this.keys = selectedKeysInView(wb);
    this.span = host.shown().selectedSpan ?? [0, 0];
  }

  move(at: Pointer): void {
    const { take: current, keys } = this;
    const { edit } = this;
    const text = current && edit && keys.length && !edit.cancelled ? this.preview(at, current, edit) : undefined;
    const count = countKeys(current?.take.channels ?? [], keys);
    this.readout = text && !edit?.cancelled ? `${text} · ${plural(count, 'key')}` : undefined;
  }

  /** Previews the edit at a position, and returns its readout. */
  protected abstract preview(at: Pointer, current: TimelineTake, edit: HandEdit): string | undefined;

  release(_at: Pointer, moved: boolean): void {
    this.readout = undefined;
    if (!moved) {
      this.edit?.cancel();
      return;
    }
    this.edit?.commit();
  }

  cancel(): void {
    this.readout = undefined;
    this.edit?.cancel();
  }

  /** Seconds moved since the press, snapped so that a key at `grabbed` is on a frame. */
  protected dragged(at: Pointer, grabbed: number, snapTurned: boolean): number {
    const { wb } = this.host;
    const sheet = this.host.sheet();
    const seconds = timeAt(sheet, at.x) - timeAt(sheet, this.from.x);
    const snaps = wb.timeline.view.get().snapsToFrames !== snapTurned;
    // Back where it began, a key between frames stays there.
    return snaps && seconds !== 0 ? snapSeconds(grabbed, seconds, wb.transport.get().framesPerSecond) : seconds;
  }
}

/** `ripple` moves all later keys of the same channels too; `copy` leaves the keys and moves duplicates. */
export type MoveWay = 'move' | 'ripple' | 'copy';

const WAY_WORDS: Readonly<Record<MoveWay, string>> = { move: '', ripple: 'Ripple ', copy: 'Copy ' };

export class MoveKeys extends KeyDrag {
  private readonly copied: CopiedKeys | undefined;
  private readonly moving: Command<ArgsOf<typeof moveKeys>, Change>;
  private readonly rippling: Command<ArgsOf<typeof rippleKeys>, Change>;

  /** @param grabbedSeconds the key to be snapped: the grabbed one, else the first */
  constructor(
    host: DopeHost,
    from: Pointer,
    private readonly way: MoveWay,
    private readonly grabbedSeconds?: number,
  ) {
    super(host, from);
    this.moving = onAllInHand(host.wb, moveKeys);
    this.rippling = onAllInHand(host.wb, rippleKeys);
    this.copied = way === 'copy' && this.take ? copyKeys(this.take.take, this.keys) : undefined;
  }

  protected preview(at: Pointer, current: TimelineTake, edit: HandEdit): string {
    const { keys, way, copied } = this;
    const { wb } = this.host;
    const { id: characterId } = current.character;
    // While copying, Ctrl doesn't switch snapping off.
    const seconds = this.dragged(at, this.grabbedSeconds ?? this.span[0], at.ctrl && way !== 'copy');
    if (copied) {
      const each = current.parts.flatMap((part) => {
        const { character: of } = part;
        const own = copiedOfPart(part, copied);
        const timeSeconds = this.span[0] + of.timeOffsetSeconds + seconds;
        const pasted = { characterId: of.id, copied: own, timeSeconds, mode: 'merge', ...keyPlacing(wb, of) } as const;
        return own.channels.length ? [pasted] : [];
      });
      const command = onEachCharacter(pasteKeys, `Paste keys on ${each.length} characters`);
      edit.preview(command, each, () =>
        addKeys(wb, command, (outsideCycle) => each.map((pasted) => ({ ...pasted, outsideCycle }))),
      );
    } else if (way === 'ripple') {
      edit.preview(this.rippling, { characterId, keys, seconds: rippleSeconds(current, keys, seconds) });
    } else {
      edit.preview(this.moving, { characterId, keys, seconds, onCollision: wb.timeline.view.get().onCollision });
    }
    return `${WAY_WORDS[way]}${amountText(wb, seconds)}`;
  }
}

/** Scales times about the other end, or with Alt about the playhead; values stay. */
export class ScaleKeys extends KeyDrag {
  private readonly scaling: Command<ArgsOf<typeof scaleKeys>, Change>;

  constructor(
    host: DopeHost,
    from: Pointer,
    private readonly end: 'start' | 'end',
  ) {
    super(host, from);
    this.scaling = onAllInHand(host.wb, scaleKeys);
  }

  protected preview(at: Pointer, { character }: TimelineTake, edit: HandEdit): string | undefined {
    const { wb } = this.host;
    const { timeSeconds, framesPerSecond } = wb.transport.get();
    const { snapsToFrames, onCollision } = wb.timeline.view.get();
    const [start, end] = this.span;
    const [moving, other] = this.end === 'end' ? [end, start] : [start, end];
    const pivot = at.alt ? timeSeconds : other;
    const reach = moving - pivot;
    // The playhead is at the dragged end: no factor is defined.
    if (Math.abs(reach) < 1e-9) return undefined;
    const by = this.dragged(at, moving, at.ctrl);
    // Never to the pivot or past it: all keys would coincide.
    const least = snapsToFrames === at.ctrl ? secondsPerPixel(this.host.sheet()) : 1 / framesPerSecond;
    const timeFactor = Math.max(Math.min(1, least / Math.abs(reach)), (reach + by) / reach);
    edit.preview(this.scaling, {
      characterId: character.id,
      keys: this.keys,
      pivotSeconds: pivot + character.timeOffsetSeconds,
      timeFactor,
      valueFactor: 1,
      onCollision,
    });
    return `× ${shown(timeFactor)}`;
  }
}

/** `+3 frames`, `−0.25 s`. */
function amountText(wb: Uses<'transport' | 'settings'>, seconds: number): string {
  const sign = seconds < 0 ? '−' : '+';
  const size = Math.abs(seconds);
  if (wb.settings.get().timeDisplay !== 'frames') return `${sign}${shown(size)} s`;
  const frames = frameNumber(size, wb.transport.get().framesPerSecond);
  return `${sign}${shown(frames, 2)} ${frames === 1 ? 'frame' : 'frames'}`;
}
