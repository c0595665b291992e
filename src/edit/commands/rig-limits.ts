/**
 * Setting limits in rigging: if that moves a joint in the displayed pose, skins may be rebound. Separate from
 * `limits.ts`, which the page has from the start.
 */

import { command } from '../command.ts';
import { boundAnew } from '../rig/apply.ts';
import { index, number } from '../schema/shape.ts';
import { RIGGING } from '../schema/shared-shapes.ts';
import { clearLimit, setLimit } from './limits.ts';

export const limitRigged = command({
  id: 'rig.setLimit',
  args: { ...RIGGING, dof: index, min: number, max: number },
  label: setLimit.label,
  run: (document, args) => boundAnew(document, args, setLimit.runRead(document, args)),
});

export const clearLimitRigged = command({
  id: 'rig.clearLimit',
  args: { ...RIGGING, dof: index },
  label: clearLimit.label,
  run: (document, args) => boundAnew(document, args, clearLimit.runRead(document, args)),
});
