/**
 * The worker that all elements of a page share. A page that can have none imports it as a module: built on its own, it
 * shares no code with the element, which is smaller for it.
 */
import { serve } from '../worker/serve.ts';
import { openCharacters } from './open.ts';

export { openCharacters } from './open.ts';

if (!('document' in globalThis)) {
  serve<'open'>(async ({ id, job, input }) => ({ id, kind: 'done', job, output: await openCharacters(input) }));
}
