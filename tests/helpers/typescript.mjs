/**
 * `node --import ./tests/helpers/typescript.mjs`: Node reads the project's TypeScript, in all versions that the project
 * supports. (Newer ones only leave types out, and know no parameter properties.)
 */
import * as module from 'node:module';
import * as hooks from './typescript-hooks.mjs';

// In the thread itself where Node can.
if (module.registerHooks) module.registerHooks(hooks);
else module.register('./typescript-hooks.mjs', import.meta.url);
