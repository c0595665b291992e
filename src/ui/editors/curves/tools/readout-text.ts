/** Texts of the plot's readouts: pointer position, and the result of a drag. */
import type { DofUnit } from '../../../../model/skeleton/skeleton.ts';
import { shownPerUnit, unitText } from '../../../state/joints/angles.ts';
import type { Uses } from '../../../state/workbench.ts';
import { MAX_DECIMALS, shown } from '../../../widgets/numbers/number-text.ts';
import { frameNumber } from '../../timeline/snapping.ts';

/** `0.4 s · 12`, or `12 · 0.4 s` if time is displayed in frames. */
export function timeText(wb: Uses<'transport' | 'settings'>, timeSeconds: number): string {
  const frames = `frame ${shown(frameNumber(timeSeconds, wb.transport.get().framesPerSecond), 1)}`;
  const seconds = `${shown(timeSeconds)} s`;
  return wb.settings.get().timeDisplay === 'frames' ? `${frames} · ${seconds}` : `${seconds} · ${frames}`;
}

/** `23.5°`, `1.24`. */
export function curveValueText(wb: Uses<'settings'>, unit: DofUnit, value: number): string {
  const { angles } = wb.settings.get();
  const inDegrees = unit === 'angle' && angles === 'degrees';
  return `${shown(value * shownPerUnit(unit, angles), inDegrees ? 2 : MAX_DECIMALS)}${unitText(unit, angles)}`;
}

/** `Δ +3 frames   +4.2°`. */
export function deltaText(wb: Uses<'transport' | 'settings'>, unit: DofUnit, seconds: number, value: number): string {
  const inFrames = wb.settings.get().timeDisplay === 'frames';
  const frames = frameNumber(seconds, wb.transport.get().framesPerSecond);
  const time = inFrames ? `${signed(shown(frames, 2))} frames` : `${signed(shown(seconds))} s`;
  return `Δ ${time}   ${signed(curveValueText(wb, unit, value))}`;
}

/** `slope 12°/s`. */
export function slopeText(wb: Uses<'settings'>, unit: DofUnit, slope: number): string {
  return `slope ${curveValueText(wb, unit, slope)}/s`;
}

function signed(text: string): string {
  return text.startsWith('−') ? text : `+${text}`;
}
