/**
 * Setting limits in rigging: if that moves a joint in the displayed pose, skins may be rebound. Separate from
 * `limits.ts`, which the page has from the start.
 */
import type { Limit } from '../../model/skeleton.ts';
import { boundAnew } from '../rig/apply.ts';
import type { Rigging } from '../rig/rigging.ts';
import type { Command } from '../store.ts';
import { clearLimit, type OfDof, setLimit } from './limits.ts';

export const limitRigged: Command<OfDof & Rigging & Limit> = {
  id: 'rig.setLimit',
  label: setLimit.label,
  run: (document, args) => boundAnew(document, args, setLimit.run(document, args)),
};

export const clearLimitRigged: Command<OfDof & Rigging> = {
  id: 'rig.clearLimit',
  label: clearLimit.label,
  run: (document, args) => boundAnew(document, args, clearLimit.run(document, args)),
};
