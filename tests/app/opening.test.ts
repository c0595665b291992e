import { describe, expect, it } from 'vitest';
import { Opener } from '../../src/app/opening.ts';
import { createRig } from '../../src/edit/commands/rig.ts';
import { DEFAULT_PLAYBACK } from '../../src/edit/playback.ts';
import { Store } from '../../src/edit/store.ts';
import { saveCharacter } from '../../src/project/save/saving.ts';
import { observable } from '../../src/ui/kit/observable.ts';
import { Messages } from '../../src/ui/state/messages.ts';
import type { Loading } from '../../src/ui/state/workbench.ts';
import { character } from '../helpers/builders.ts';
import { InThisThread } from './in-this-thread.ts';

function openerOf(store: Store): Opener {
  return new Opener({
    store,
    transport: observable(DEFAULT_PLAYBACK),
    messages: new Messages(),
    loading: observable<Loading | undefined>(undefined),
    viewport: { frameAll: () => undefined },
    worker: new InThisThread(),
  });
}
const sample = () => [{ path: 'walker.skel', blob: new Blob([saveCharacter(character(), 'skel')[0].text]) }];
const shown = ({ document: { characters, isOpeningSample } }: Store) => ({
  names: characters.map(({ name }) => name),
  isOpeningSample,
});

describe('the opening sample', () => {
  it('the opening sample is there to be looked at, without a step', async () => {
    const store = new Store();
    await openerOf(store).open(sample, { asOpeningSample: true });
    expect(shown(store)).toEqual({ names: ['walker'], isOpeningSample: true });
    expect(store.undoLabel).toBeUndefined();
  });

  it('stays away where something was begun before it came', async () => {
    const store = new Store();
    const opening = openerOf(store).open(sample, { asOpeningSample: true });
    store.apply(createRig, {});
    await opening;
    expect(shown(store)).toEqual({ names: ['character'], isOpeningSample: false });
  });
});
