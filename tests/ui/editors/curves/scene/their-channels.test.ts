import { describe, expect, it } from 'vitest';
import { DEFAULT_PLAYBACK } from '../../../../../src/edit/playback.ts';
import { Store } from '../../../../../src/edit/store.ts';
import { readDump } from '../../../../../src/formats/dump/read.ts';
import type { Character } from '../../../../../src/model/document.ts';
import { PlotScene } from '../../../../../src/ui/editors/curves/plot-scene.ts';
import { fit as fitted, timesOf } from '../../../../../src/ui/editors/curves/scene/fit.ts';
import { sampleNear, theirChannels, theirsText } from '../../../../../src/ui/editors/curves/scene/their-channels.ts';
import { type ComparedResult, DumpComparison } from '../../../../../src/ui/state/dump-comparison.ts';
import { onResult } from '../../../../../src/ui/state/shown-comparison.ts';
import { observable } from '../../../../../src/ui/widgets/observable.ts';
import { compareDumps } from '../../../../../src/worker/compare-program.ts';
import { describeShared, sharedBytes } from '../../../../helpers/shared.ts';
import { characterOf, SHARED } from '../../../../teaching/lesson-files.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../../builders.ts';

const TOLERANCE = 1e-4;

function compared(of: Character, text: Uint8Array | string): ComparedResult {
  const { value } = readDump(text, 'mine.txt');
  if (!value) throw new Error('No dump.');
  const dumps = [{ fileName: 'mine.txt', dump: value }];
  const output = compareDumps({ character: of, dumps, tolerance: TOLERANCE }, () => undefined);
  const { comparison, targets } = output;
  if (!comparison || !targets) throw new Error('Nothing was compared.');
  return { comparison, targets, character: of, tolerance: TOLERANCE };
}

/** One channel that is 0 everywhere, three DOFs of the root. */
const still = character({ skeleton: skeleton(['hips', -1]), takes: [take([0, 1], channel(0, 1))] });

/** A page on which this is compared with its character. */
async function pageWith(result: ComparedResult) {
  const { wb } = workbench(documentOf(result.character));
  const run = async () => ({ comparison: result.comparison, targets: result.targets, inFilePose: [], diagnostics: [] });
  const comparing = new DumpComparison(wb, result.character.id, [], run);
  await Promise.resolve();
  await Promise.resolve();
  return { wb, comparing };
}

describe('channels of another program', () => {
  it('are in the order of their times, with what is wrong in them', () => {
    const text = 'channel 0\n0.5 0.25\n0 0\n1 0.00001\n0.75 nan';
    const own = theirChannels(compared(still, text))?.get(0);
    expect([...(own?.times ?? [])]).toEqual([0, 0.5, 0.75, 1]);
    expect([...(own?.values ?? [])]).toEqual([0, 0.25, Number.NaN, 0.00001]);
    expect([...(own?.ours ?? [])]).toEqual([0, 0, 0, 0]);
    expect([...(own?.wrong ?? [])]).toEqual([0, 1, 1, 0]);
    expect([own?.firstWrong, own?.largest]).toEqual([0.5, Number.POSITIVE_INFINITY]);
  });

  it('are told in words, for those who don’t see the curves', () => {
    const told = (text: string) => {
      const own = theirChannels(compared(still, text))?.get(0);
      return own && theirsText(own);
    };
    expect(told('channel 0\n0 0\n1 0')).toBe('yours agrees');
    expect(told('channel 0\n0 0\n0.5 0.25\n1 0')).toBe('yours differs by up to 0.25, first at 0.5 s');
    expect(told('channel 0\n0 nan\n1 0')).toBe('yours differs, with values that are not numbers, first at 0 s');
  });

  it('the value nearest to a time is found, unless it is too far', () => {
    const own = theirChannels(compared(still, 'channel 0\n0 0\n0.5 0\n1 0'))?.get(0);
    if (!own) throw new Error('No channel.');
    expect([0.49, 0.52, 0.7, 1.01, -0.01].map((time) => sampleNear(own, time, 0.05))).toEqual([1, 1, -1, 2, 0]);
  });

  it('are drawn by the curve editor, and fitted with ours', async () => {
    const { wb, comparing } = await pageWith(compared(still, 'channel 0\n0 0\n3 5'));
    const plot = new PlotScene(wb);
    plot.width = 400;
    plot.height = 200;
    expect(plot.scene.theirs).toBeUndefined();
    let heard = 0;
    const stop = onResult(wb, () => {
      heard++;
      plot.invalidate();
    });
    wb.comparing.set(comparing);
    expect(heard).toBe(1);
    expect([...(plot.theirs(0)?.values ?? [])]).toEqual([0, 5]);
    expect(plot.theirs(1)).toBeUndefined();
    const [from, to] = timesOf(plot.scene);
    expect([from, to]).toEqual([0, 3]);
    const space = { ...plot.scene.space, window: { from, to } };
    expect(fitted({ ...plot.scene, space }, 'values').axes.length.high).toBeGreaterThan(5);
    wb.comparing.set(undefined);
    expect([heard, plot.scene.theirs]).toEqual([2, undefined]);
    stop();
  });

  it('of one character are not drawn over another', async () => {
    const { wb, comparing } = await pageWith(compared(still, 'channel 0\n0 0\n1 0'));
    wb.comparing.set(comparing);
    const other = { ...still, id: 'other' };
    const store = new Store(documentOf(other));
    const plot = new PlotScene({ ...wb, store, transport: observable({ ...DEFAULT_PLAYBACK }) });
    expect(plot.scene.lines.length).toBeGreaterThan(0);
    expect(plot.scene.theirs).toBeUndefined();
  });
});

describeShared('channels of the reference’s dumps', () => {
  it.each([
    ['d006.txt', false],
    ['d029.txt', true],
  ])('channels of %s are wrong where the comparison says so', (name, isWrong) => {
    const result = compared(characterOf(...SHARED.curves), sharedBytes(`conformance/compare/${name}`));
    const all = theirChannels(result) ?? new Map();
    expect(all.size).toBe(result.comparison.compared.channels);
    const wrong = [...all].filter(([, { firstWrong }]) => firstWrong !== undefined);
    expect(wrong.length > 0).toBe(isWrong);
    const { first } = result.comparison;
    expect(wrong[0]?.[0]).toBe(first?.index);
    expect(wrong[0]?.[1].firstWrong).toBe(first?.time);
  });
});
