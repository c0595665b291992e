/** The option of commands that read takes with layers. */
import { KEEP } from '../../files/open/layers.ts';
import { oneOf } from './kinds.ts';
import { option } from './option.ts';

/** What counts where a plain file was edited since it was saved with its layers. */
export const KEEP_OPTION = {
  keep: option(
    oneOf(KEEP),
    'Takes this of a take whose plain file was edited since it was saved with its layers: the edit, or the controls.',
    { default: 'edit' },
  ),
};
