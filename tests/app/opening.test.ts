import { describe, expect, it } from 'vitest';
import { Opener } from '../../src/app/opening.ts';
import { createRig } from '../../src/edit/commands/rig.ts';
import { DEFAULT_PLAYBACK } from '../../src/edit/playback.ts';
import { Store } from '../../src/edit/store.ts';
import { saveCharacter } from '../../src/project/save/saving.ts';
import { observable } from '../../src/ui/kit/observable.ts';
import { Messages } from '../../src/ui/state/messages.ts';
import type { Loading } from '../../src/ui/state/workbench.ts';
import { character, clip } from '../helpers/builders.ts';
import { InThisThread } from './in-this-thread.ts';

function openerOf(store: Store, { transport = observable(DEFAULT_PLAYBACK), reducesMotion = false } = {}): Opener {
  return new Opener({
    store,
    transport,
    messages: new Messages(),
    loading: observable<Loading | undefined>(undefined),
    viewport: { frameAll: () => undefined },
    worker: new InThisThread(),
    reducesMotion: () => reducesMotion,
  });
}
const sample = () => [{ path: 'walker.skel', blob: new Blob([saveCharacter(character(), 'skel')[0].text]) }];
const shown = ({ document: { characters, isOpeningSample } }: Store) => ({
  names: characters.map(({ name }) => name),
  isOpeningSample,
});

describe('the opening sample', () => {
  it('the opening example is shown without an undo step', async () => {
    const store = new Store();
    await openerOf(store).open(sample, { asOpeningSample: true });
    expect(shown(store)).toEqual({ names: ['walker'], isOpeningSample: true });
    expect(store.undoLabel).toBeUndefined();
  });

  it('the opening sample is not opened if something else was begun before', async () => {
    const store = new Store();
    const opening = openerOf(store).open(sample, { asOpeningSample: true });
    store.apply(createRig, {});
    await opening;
    expect(shown(store)).toEqual({ names: ['character'], isOpeningSample: false });
  });
});

it('opening selects a new character, keeps the selection for a part of the selected one, and undo restores it', async () => {
  const store = new Store();
  const opener = openerOf(store);
  await opener.open(sample);
  expect(store.selection).toEqual({ characterId: 'c1' });
  const joint = { characterId: 'c1', joint: 1 };
  store.select(joint);
  const walk = saveCharacter(character({ clips: [clip('walker_walk', [1])] }), 'anim')[0].text;
  await opener.open(() => [{ path: 'walker_walk.anim', blob: new Blob([walk]) }]);
  expect(store.selection).toEqual(joint);
  const [{ blob }] = sample();
  await opener.open(() => [{ path: 'runner.skel', blob }]);
  expect(store.selection).toEqual({ characterId: 'c2' });
  store.undo();
  expect(store.selection).toEqual(joint);
});

it.each([false, true])('a new take starts to play unless motion is to be reduced: %s', async (reducesMotion) => {
  const transport = observable({ ...DEFAULT_PLAYBACK, timeSeconds: 1.5 });
  const opener = openerOf(new Store(), { transport, reducesMotion });
  const walk = saveCharacter(character({ clips: [clip('walker_walk', [1])] }), 'anim')[0].text;
  await opener.open(() => [...sample(), { path: 'walker_walk.anim', blob: new Blob([walk]) }]);
  expect(transport.get().playing).toBe(!reducesMotion);
  expect(transport.get().timeSeconds).toBe(transport.get().range[0]);
});
