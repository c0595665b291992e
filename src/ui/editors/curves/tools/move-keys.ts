/**
 * A press on a key: selects it as a click does; dragging moves the whole selection.
 *
 * All selected keys move equally on screen. On one axis that is the same amount; if axes differ (radians and lengths,
 * or normalised curves) each moves by what the pixels mean on its own.
 */

import { moveKeys } from '../../../../edit/commands/keys.ts';
import { hasKey, toggleKeys, unionKeys, withoutKeys } from '../../../../edit/keys/selection.ts';
import { wholeSteps } from '../../../../edit/keys/steps.ts';
import type { ChannelKeys } from '../../../../model/session.ts';
import type { KeyedChannel } from '../../../../model/takes/take.ts';
import { shownPerUnit } from '../../../state/joints/angles.ts';
import { timeAt, timeX } from '../../../widgets/time/time-window.ts';
import { editOfTakes, onAllInHand, selectedKeys, selectedKeysInView, selectKeys } from '../../timeline/current-take.ts';
import { snapSeconds, snapValue, valueStep } from '../../timeline/snapping.ts';
import { timelineTake } from '../../timeline/timeline-take.ts';
import { type CurveHit, type CurveLine, lineOf } from '../scene/scene.ts';
import { type CurveSpace, pixelsPerUnit, yOf } from '../scene/space.ts';
import { deltaText } from './readout-text.ts';
import type { Drag, PlotAccess, PointerAt } from './tool.ts';

type KeyHit = Extract<CurveHit, { kind: 'key' }>;

export function keysDrag(plot: PlotAccess, hit: KeyHit, from: PointerAt): Drag {
  const { wb } = plot;
  const grabbed: ChannelKeys = { channel: hit.channel, indices: [hit.index] };
  const before = selectedKeys(wb);
  const wasSelected = hasKey(before, hit.channel, hit.index);
  if (!wasSelected && !from.ctrl) selectKeys(wb, from.shift ? unionKeys(before, [grabbed]) : [grabbed]);

  const move = mover(plot, hit, from);
  return {
    cursor: (at) => (at.shift ? (isSideways(from, at) ? 'ew-resize' : 'ns-resize') : 'move'),
    move: (at) => move?.to(at),
    end(at, moved) {
      if (moved) move?.to(at);
      move?.edit.commit();
      if (moved || !wasSelected) return;
      // A click on a selected key deselects all others, or with a modifier only this one.
      if (from.shift) selectKeys(wb, toggleKeys(before, [grabbed]));
      else if (from.ctrl) selectKeys(wb, withoutKeys(before, [grabbed]));
      else selectKeys(wb, [grabbed]);
    },
    cancel: () => move?.edit.cancel(),
    cancelled: () => move?.edit.cancelled ?? false,
  };
}

/** Moves the keys selected at the press. */
function mover(plot: PlotAccess, hit: KeyHit, from: PointerAt) {
  const { wb } = plot;
  const scene = plot.scene();
  const current = timelineTake(wb);
  const line = scene && lineOf(scene, hit.channel);
  const channel = current?.take.channels[hit.channel];
  if (!scene || !current || !line || channel?.kind !== 'keys') return undefined;
  const keyTime = channel.times[hit.index] - current.character.timeOffsetSeconds;
  const keyValue = channel.values[hit.index];
  // Offset of the grab within the key, kept while dragging, even if the view is zoomed meanwhile.
  const offX = from.x - timeX(scene.space, keyTime);
  const offY = from.y - yOf(scene.space, line, keyValue);
  const edit = editOfTakes(wb, current.parts);
  const command = onAllInHand(wb, moveKeys);
  const drawn = new Map(scene.lines.map((l) => [l.channel, l]));
  const keys = withOneHalf(selectedKeysInView(wb), hit, channel);

  const to = (at: PointerAt) => {
    const space = plot.scene()?.space ?? scene.space;
    const sideways = isSideways(from, at);
    const view = wb.timeline.view.get();
    const framesPerSecond = wb.transport.get().framesPerSecond;
    let seconds = at.shift && !sideways ? 0 : timeAt(space, at.x - offX) - keyTime;
    let value = at.shift && sideways ? 0 : (yOf(space, line, keyValue) + offY - at.y) / pixelsPerUnit(space, line);
    if (seconds !== 0 && view.snapsToFrames !== at.ctrl) seconds = snapSeconds(keyTime, seconds, framesPerSecond);
    if (value !== 0 && view.snapsToValues !== at.ctrl) {
      const shownPer = shownPerUnit(line.unit, wb.settings.get().angles);
      value = snapValue(keyValue, value, valueStep(pixelsPerUnit(space, line), shownPer));
    }
    edit.preview(command, {
      characterId: current.character.id,
      keys,
      seconds,
      values: keys.map((k) => valueFor(space, line, drawn.get(k.channel), value)),
      onCollision: view.onCollision,
    });
    if (!edit.cancelled) plot.say(deltaText(wb, line.unit, seconds, value));
  };
  return { edit, to };
}

/**
 * Of a step of which one half is grabbed, and nothing else, only that half moves in value: the jump changes. In time
 * both do, by the command.
 */
function withOneHalf(keys: readonly ChannelKeys[], { channel, index }: KeyHit, curve: KeyedChannel) {
  const step = wholeSteps(curve, [index]);
  const isAlone = keys.length === 1 && keys[0].channel === channel && keys[0].indices.length === step.length;
  return isAlone ? [{ channel, indices: [index] }] : keys;
}

/** The change of a key of `other` when one of `line` changes by `value`. */
function valueFor(space: CurveSpace, line: CurveLine, other: CurveLine | undefined, value: number): number {
  if (!other) return 0;
  if (other.axis === line.axis && other.normalise?.scale === line.normalise?.scale) return value;
  return (value * pixelsPerUnit(space, line)) / pixelsPerUnit(space, other);
}

/** Whether it has moved more horizontally than vertically. */
export function isSideways(from: PointerAt, at: PointerAt): boolean {
  return Math.abs(at.x - from.x) >= Math.abs(at.y - from.y);
}
