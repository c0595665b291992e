/**
 * Properties try the same cases in every run: whether `npm test` passes depends on the change, never on luck. Cases
 * that nobody has tried come by MARROW_SEED: a number, the seed that a failure prints, or `random`.
 */
import { env } from 'node:process';
import fc from 'fast-check';

const asked = env.MARROW_SEED ?? '169';
const seed = asked === 'random' ? Math.floor(Math.random() * 2 ** 31) : Number(asked);
if (!Number.isInteger(seed)) throw new Error(`MARROW_SEED is "${asked}". Give an integer, or "random".`);
fc.configureGlobal({ ...fc.readConfigureGlobal(), seed });
