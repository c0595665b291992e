import { describe, expect, it } from 'vitest';
import { keyPose } from '../../../../src/edit/commands/keying.ts';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { unkeyedAt } from '../../../../src/edit/unkeyed.ts';
import { shownTake } from '../../../../src/model/document.ts';
import { emptyPlotText } from '../../../../src/ui/editors/curves/empty-text.ts';
import { restCurves, restValues } from '../../../../src/ui/editors/curves/scene/rest-curves.ts';
import * as edits from '../../../../src/ui/editors/layers/edits.ts';
import { placeAfterDrop } from '../../../../src/ui/editors/layers/order-drag.ts';
import { dopeRows } from '../../../../src/ui/editors/timeline/dope-rows.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

const WHO = { characterId: 'c1', timeSeconds: 0.5 };

function walking() {
  const walk = take([0, 1], ...Array.from({ length: 9 }, () => channel(0, 1)));
  const hero = character({ skeleton: skeleton(['hips', -1], ['arm', 0]), takes: [walk], clampsToLimits: false });
  const { wb } = workbench(documentOf(hero), { timeSeconds: 0.5 });
  wb.store.select({ characterId: 'c1', joint: 1 });
  const now = () => wb.store.document.characters[0];
  const stack = () => shownTake(now())?.layers;
  return { wb, now, stack };
}

describe('layers in the page', () => {
  it('are added above the others, active, masked to the selected joints if asked, and say so', () => {
    const { wb, stack } = walking();
    edits.add(wb);
    expect(stack()).toMatchObject({ active: 0, list: [{ name: 'layer' }] });
    edits.add(wb, true);
    expect(stack()).toMatchObject({ active: 1, list: [{}, { name: 'layer 2', joints: ['arm'] }] });
    expect(wb.messages.passing.get()).toBe(
      'Layer “layer 2” is active: poses and keys go into it, and walk stays below as it is.',
    );
  });

  it('take what was posed before they were added', () => {
    const { wb, now } = walking();
    wb.store.apply(setDofs, { ...WHO, dofs: [{ index: 6, value: 0.7 }] });
    edits.add(wb);
    expect([...unkeyedAt(now(), 0.5)]).toEqual([[6, 0.7]]);
    wb.store.apply(keyPose, { ...WHO, dofs: [6] });
    expect(shownTake(now())?.channels[6]).toMatchObject({ kind: 'keys', values: Float64Array.of(0.7) });
  });

  it('are added and keyed in one step, over a capture', () => {
    const { wb, stack, now } = walking();
    wb.store.apply(setDofs, { ...WHO, dofs: [{ index: 6, value: 0.7 }] });
    const before = wb.store.document;
    edits.addAndKey(wb, { ...WHO, dofs: [6] });
    expect(stack()?.list).toHaveLength(1);
    expect(shownTake(now())?.channels[6]).toMatchObject({ values: Float64Array.of(0.7) });
    wb.store.undo();
    expect(wb.store.document).toEqual(before);
  });

  it('are stepped through, moved, muted, solo, named, masked, merged and removed, a step each', () => {
    const { wb, stack } = walking();
    edits.add(wb);
    edits.add(wb);
    edits.step(wb, 1);
    expect(stack()?.active).toBe(1);
    edits.step(wb, -1);
    edits.step(wb, -1);
    edits.step(wb, -1);
    expect(stack()?.active).toBe(-1);
    edits.activate(wb, 0);
    edits.move(wb, 1);
    expect(stack()).toMatchObject({ active: 1, list: [{ name: 'layer 2' }, { name: 'layer' }] });
    edits.toggle(wb, 'mute');
    edits.toggle(wb, 'solo', 0);
    edits.toggleMode(wb);
    edits.rename(wb, 1, ' arm ');
    edits.rename(wb, 1, '  ');
    edits.mask(wb);
    edits.toggleTouched(wb, 1, 'root');
    const named = { name: 'arm', mode: 'override', mute: true, joints: ['arm'], root: true };
    expect(stack()?.list).toMatchObject([{ solo: true }, named]);
    expect(wb.store.undoLabel).toBe('Set layer arm');
    wb.store.undo();
    expect(stack()?.list[1].root).toBe(false);
    edits.unmask(wb, 1);
    expect(stack()?.list[1].joints).toBeUndefined();
    edits.remove(wb);
    edits.flatten(wb);
    expect(stack()).toBeUndefined();
  });

  it('have a weight that is keyed where it is, follows the slider from then on, and can be one for all times again', () => {
    const { wb, stack, now } = walking();
    edits.add(wb);
    edits.keyWeight(wb);
    expect(stack()?.list[0].weight).toMatchObject({ times: Float64Array.of(0.5), values: Float64Array.of(1) });
    const preview: unknown[] = [];
    edits.previewWeight(wb, { preview: (...given: unknown[]) => preview.push(given[1]) } as never, 0, 0.3);
    expect(preview).toEqual([{ characterId: 'c1', layer: 0, timeSeconds: 0.5, weight: 0.3 }]);
    expect(edits.layersNow(now(), 0.5)[0].weight).toBe(1);
    edits.unkeyWeight(wb, 0);
    expect(stack()?.list[0].weight).toBe(1);
  });

  it('lie over the sum of the others, with rows for what has keys only there', () => {
    const { wb, now } = walking();
    edits.add(wb);
    wb.store.apply(setDofs, { ...WHO, dofs: [{ index: 6, value: 2 }] });
    wb.store.apply(keyPose, { ...WHO, dofs: [6] });
    const own = shownTake(now());
    const rest = own && restCurves(own, now().skeleton);
    if (!own || !rest) throw new Error('There are no layers.');
    expect([...restValues(rest, 0, 0.5, 2).values]).toEqual(new Array(18).fill(0));
    expect(rest.weight).toBeUndefined();
    edits.keyWeight(wb);
    const keyed = shownTake(now());
    const weighted = keyed && restCurves(keyed, now().skeleton);
    expect(weighted?.weight?.name).toBe('layer');
    expect(weighted && [...restValues(weighted, 0, 0.5, 2).weights]).toEqual([1, 1]);
    const rows = dopeRows(now(), own, { unfolded: [], all: false, filter: '' });
    expect(rows.map(({ label }) => label)).toEqual(['', 'Root translation', 'hips', 'arm']);
    edits.activate(wb, -1);
    const base = shownTake(now());
    const all = base && restCurves(base, now().skeleton);
    expect(all && restValues(all, 0.5, 1, 1).values[6]).toBe(2);
    edits.activate(wb, 0);
    expect(emptyPlotText(wb, 3)).toMatch(/^Layer “layer” has no keys of these channels yet/);
  });
});

it('a layer that is dropped between two comes where the line was', () => {
  expect([0, 1, 2, 3].map((gap) => placeAfterDrop(1, gap))).toEqual([0, 1, 1, 2]);
});
