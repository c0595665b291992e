import { expect, it } from 'vitest';
import { followLoneSkins } from '../../../../src/ui/editors/rig/offer-skeleton.ts';
import { skin } from '../../../helpers/builders.ts';
import { character, documentOf, skeleton, workbench } from '../../builders.ts';

it('a skin that is opened without a skeleton is offered one, and one that has it is not', () => {
  const { wb } = workbench();
  followLoneSkins(wb);
  const said = () => wb.messages.list.get().map(({ text }) => text);
  const whole = character({ id: 'whole', skins: [skin('tube')], skeleton: skeleton(['root', -1]) });
  wb.store.replace('Open whole', documentOf(whole));
  expect(said()).toEqual([]);
  const lone = character({ id: 'lone', name: 'tube', skins: [skin('tube')] });
  wb.store.replace('Open tube', documentOf(whole, lone));
  expect(said()).toEqual(['tube is a skin without a skeleton: it can’t be posed.']);
  expect(wb.messages.offers.map(({ label }) => label)).toEqual(['New skeleton', 'Add a .skel…']);
  // With its skeleton the message is over.
  wb.store.replace('Open tube.skel', documentOf(whole, { ...lone, skeleton: skeleton(['root', -1]) }));
  wb.messages.leaveOver();
  expect(wb.messages.passing.get()).toBeUndefined();
});
