/** What is asked where the plain files of layers were edited since. */
import { expect, it } from 'vitest';
import { askWhatToKeep } from '../../src/app/opened-layers.ts';
import { Store } from '../../src/edit/store.ts';
import { Messages } from '../../src/ui/state/messages.ts';

it.each([
  [['walk.anim'], 'walk.anim was edited since it was saved with its layers. The edit is open, without layers.'],
  [
    ['a/walk.anim', 'b/walk.anim'],
    'a/walk.anim, b/walk.anim were edited since they were saved with their layers. The edits are open, without layers.',
  ],
])('of %j it is asked which to keep, the layers by opening the files again', (edited, text) => {
  const messages = new Messages();
  const opened: object[] = [];
  askWhatToKeep({ layers: { edited } }, {}, { messages, store: new Store() }, (options) => opened.push(options));
  expect(messages.passing.get()).toBe(text);
  messages.offers[1].run();
  expect(opened).toEqual([{ keep: 'controls' }]);
  expect(messages.list.get()).toEqual([]);
});
