/** Real skeletons with random takes, as GLB files show them at times that no fitting has looked at. */
import { describeShared } from '../../helpers/shared.ts';
import { eachWithin } from './each-within.ts';
import { lastPart, movedCharacters } from './many-characters.ts';

describeShared('real skeletons with random takes as GLB at unseen times', () =>
  eachWithin(lastPart(movedCharacters((name) => /calm|wild/.test(name)))),
);
