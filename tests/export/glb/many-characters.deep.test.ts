/**
 * Real files and random characters of all kinds, as GLB files show them at times that no fitting has looked at. Real
 * skeletons with random takes have a file of their own, so that both cores of a small machine have work.
 */
import { describe } from 'vitest';
import { describeShared } from '../../helpers/shared.ts';
import { eachWithin } from './each-within.ts';
import { lastPart, randomCharacters, realCharacters } from './many-characters.ts';

describeShared('real files as GLB at unseen times', () => eachWithin(realCharacters()));

describe('random skeletons as GLB at unseen times', () => eachWithin(lastPart(randomCharacters(12))));
