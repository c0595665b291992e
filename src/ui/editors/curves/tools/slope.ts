/**
 * Dragging a tangent handle sets the slope of its side. The other side follows if both had the same slope (or always,
 * or never: a timeline setting); Alt breaks, Ctrl unifies.
 */

import type { Change } from '../../../../edit/change.ts';
import type { ArgsOf, Command } from '../../../../edit/command.ts';
import { setSlopes } from '../../../../edit/commands/tangents.ts';
import { isStepped } from '../../../../edit/keys/steps.ts';
import { keySlope } from '../../../../evaluate/slopes.ts';
import type { HandleMode } from '../../../state/timeline.ts';
import { editOfTakes, selectedKeys } from '../../timeline/current-take.ts';
import { onAllShown } from '../../timeline/edit-all.ts';
import { keysOfPart, timelineTake } from '../../timeline/timeline-take.ts';
import { slopeFromHandle } from '../scene/handles.ts';
import { type CurveHit, lineOf } from '../scene/scene.ts';
import { slopeText } from './readout-text.ts';
import type { Drag, PlotAccess, PointerAt } from './tool.ts';

type HandleHit = Extract<CurveHit, { kind: 'handle' }>;

export function slopeDrag(plot: PlotAccess, hit: HandleHit): Drag {
  const { wb } = plot;
  const current = timelineTake(wb);
  const channel = current?.take.channels[hit.channel];
  const edit = current && editOfTakes(wb, current.parts);
  const wereEqual =
    channel?.kind === 'keys' && sameSlope(keySlope(channel, hit.index, 'in'), keySlope(channel, hit.index, 'out'));
  const selected = selectedKeys(wb);
  // Sets one key's slope, but keeps the whole selection with its handles. A held step after the key ends, and with it
  // what the indices of other keys mean.
  const endsStep = channel?.kind === 'keys' && isStepped(channel, hit.index) && hit.side === 'out';
  const own = current ? onAllShown(current, setSlopes) : setSlopes;
  const command: Command<ArgsOf<typeof setSlopes>, Change> = {
    ...own,
    run(document, args) {
      const change = own.run(document, args);
      const kept = (current?.parts ?? []).map((part) => [part.character.id, keysOfPart(part, selected)] as const);
      return endsStep ? change : { ...change, keysOf: new Map(kept) };
    },
  };

  const move = (at: PointerAt) => {
    const scene = plot.scene();
    const line = scene && lineOf(scene, hit.channel);
    if (!scene || !current || !edit || !line) return;
    const slope = slopeFromHandle(scene, line, hit.index, hit.side, at.x, at.y);
    const both = !endsStep && movesBoth(wb.timeline.view.get().handles, wereEqual, at);
    edit.preview(command, {
      characterId: current.character.id,
      keys: [{ channel: hit.channel, indices: [hit.index] }],
      side: both ? 'both' : hit.side,
      slope,
    });
    if (!edit.cancelled) plot.say(slopeText(wb, line.unit, slope));
  };
  return {
    cursor: () => 'grabbing',
    move,
    end(at, moved) {
      if (moved) move(at);
      edit?.commit();
    },
    cancel: () => edit?.cancel(),
    cancelled: () => edit?.cancelled ?? false,
  };
}

/** Whether the opposite handle moves too. */
export function movesBoth(
  mode: HandleMode,
  wereEqual: boolean,
  at: { readonly alt: boolean; readonly ctrl: boolean },
): boolean {
  if (at.alt) return false;
  if (at.ctrl) return true;
  return mode === 'auto' ? wereEqual : mode === 'together';
}

/** Equal up to rounding. */
export function sameSlope(a: number, b: number): boolean {
  return Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(a), Math.abs(b));
}
