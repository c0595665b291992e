import { describe, expect, it } from 'vitest';
import { CommandError } from '../../../src/edit/command-error.ts';
import { convertSteps, convertToKeys } from '../../../src/edit/commands/samples.ts';
import { Store } from '../../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { shownTake } from '../../../src/model/document.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { CHAIN, documentWith, swing, swinging, takeOfColumns, WIDTH } from './made.ts';

const tolerance = { position: 0.02, angle: 0.02 };
const args = { characterId: 'c1', tolerance };

function converted(take = swing, more: object = {}) {
  const steps = convertSteps(documentWith(take), { ...args, ...more });
  let step = steps.next();
  const parts: number[] = [];
  for (; !step.done; step = steps.next()) parts.push(step.value);
  const after = shownTake(step.value.edit.document.characters[0]);
  if (!after) throw new Error('the take is gone');
  return { after, report: step.value.report, parts };
}

/** The head's End Site at a time. */
function tip(take: typeof swing, seconds: number): number[] {
  const pose = new Float64Array(WIDTH);
  poseAt(swinging(take), seconds, pose);
  const world = new Float64Array(16 * 3);
  worldMatrices(compileSkeleton(CHAIN), pose, world);
  return [0, 1, 2].map((r) => world[32 + 12 + r] + 0.5 * world[32 + 4 + r]);
}

describe('converting samples to keys', () => {
  it('converting samples to keys keeps every joint and End Site within tolerance, with far fewer keys', () => {
    const { after, report } = converted();
    expect(report.worstPosition.error).toBeLessThanOrEqual(tolerance.position);
    expect(report.worstAngle.error).toBeLessThanOrEqual(tolerance.angle);
    expect(report.keysAfter).toBeLessThan(report.samplesBefore / 8);
    let worst = 0;
    for (let f = 0; f <= 120; f++) {
      const [a, b] = [tip(swing, f / 60), tip(after, f / 60)];
      worst = Math.max(worst, Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
    expect(worst).toBeGreaterThan(0);
    expect(worst).toBeLessThanOrEqual(report.worstPosition.error + 1e-9);
  });

  it('tightens until it holds, however little is allowed', () => {
    const { report } = converted(swing, { tolerance: { position: 1e-5, angle: 1e-5 } });
    expect(report.worstPosition.error).toBeLessThanOrEqual(1e-5);
    expect(report.worstAngle.error).toBeLessThanOrEqual(1e-5);
  });

  it('leaves the samples when nothing follows them any more, and keeps them for what does', () => {
    expect('samples' in converted().after).toBe(false);
    const some = converted(swing, { channels: [6, 7, 8] }).after;
    expect(some.samples).toBe(swing.samples);
    expect(some.channels.map((c) => keysOf(c).times.length > 0)).toEqual(
      Array.from({ length: WIDTH }, (_, c) => c >= 6 && c < 9),
    );
  });

  it('takes jumps out of angles before fitting them', () => {
    // Twice around: −180 … 180 as files have it.
    const turning = takeOfColumns((c, t) => (c === 3 ? ((360 * t + 180) % 360) - 180 : 0));
    const { after } = converted(turning);
    const { values } = keysOf(after.channels[3]);
    expect(values[values.length - 1]).toBeCloseTo(4 * Math.PI, 6);
    expect(values.length).toBeLessThan(6);
  });

  it('converting samples to keys makes one key of a constant channel', () => {
    const { after } = converted(takeOfColumns(() => 7));
    expect(after.channels.map((c) => keysOf(c).times.length)).toEqual(new Array(WIDTH).fill(1));
    expect(keysOf(after.channels[0]).values[0]).toBe(7);
  });

  it('pauses with the part that is done, which never falls', () => {
    const { parts } = converted();
    expect(parts.length).toBeGreaterThan(5);
    expect(parts).toEqual([...parts].sort((a, b) => a - b));
    expect(Math.max(...parts)).toBeLessThanOrEqual(1);
  });

  it('converting samples to keys fits long takes piece by piece, as smoothly', () => {
    const long = takeOfColumns((c, t) => (c === 3 ? 40 * Math.sin(t) : 0), 5000);
    const { after, report } = converted(long);
    expect(report.worstAngle.error).toBeLessThanOrEqual(tolerance.angle);
    const { times } = keysOf(after.channels[3]);
    expect(times.every((t, k) => k === 0 || t > times[k - 1])).toBe(true);
    expect(times.length).toBeLessThan(200);
  });

  it('converting samples to keys is one step, undone to the very samples', () => {
    const store = new Store(documentWith());
    store.apply(convertToKeys, args);
    expect(store.undoLabel).toBe('Convert swing to keys');
    store.undo();
    expect(shownTake(store.document.characters[0])?.samples?.values).toBe(swing.samples?.values);
  });

  it('refuses tolerances of nothing, and takes without samples', () => {
    const refused = (more: object, take = swing) =>
      expect(() => convertToKeys.run(documentWith(take), { ...args, ...more })).toThrow(CommandError);
    refused({ tolerance: { position: 0, angle: 1 } });
    refused({ tolerance: 1 });
    refused({ channels: [99] });
    refused({}, converted().after);
  });
});
