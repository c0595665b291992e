/** Real skeletons with random takes, as GLB files show them at times that no fitting has looked at. */
import { describeShared } from '../../helpers/shared.ts';
import { eachWithin } from './each-within.ts';
import { lastPart, movedCharacters } from './many-characters.ts';

/** The two that take longest. */
const LARGE = /^(dragon|nine) /;

describeShared('real skeletons with random takes as GLB at unseen times', () =>
  // Wild takes have smooth keys, too: calm ones show nothing else, in half the time.
  eachWithin(lastPart(movedCharacters((name) => (LARGE.test(name) ? / calm$/ : / wild$/).test(name)))),
);
