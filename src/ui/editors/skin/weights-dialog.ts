/** The dialog for computing skin weights: maximum joints per vertex, and how mesh and skeleton connect. */
import {
  type AutoWeighted,
  type AutoWeights,
  autoWeights,
  autoWeightsSteps,
  type BindPlace,
  bindPlaces,
  meanInfluences,
  USUAL_INFLUENCES,
} from '../../../edit/commands/skin-weights.ts';
import { shownSkin } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { vertexCount } from '../../../model/skin.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element } from '../../widgets/dom.ts';
import { type Asked, askChoice, askNumber } from '../../widgets/form/form.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { toolDialog } from '../timeline/tool-dialog.ts';

const TITLE = 'Automatic skin weights';

const PLACES: Readonly<Record<BindPlace, string>> = {
  bound: 'Original bind pose',
  drawn: 'Current pose',
  file: 'Mesh as in file',
};

export function weightsDialog(
  wb: Uses<'store' | 'transport' | 'timeline' | 'messages' | 'dialog'>,
  close: () => void,
): DialogContent {
  const character = currentCharacter(wb);
  const skin = character && shownSkin(character);
  if (!character?.skeleton || !skin) {
    const said = element('p', {}, 'Open a character with a skeleton and a skin first.');
    return { title: TITLE, body: said, kind: 'tool-dialog' };
  }
  const { skeleton } = character;
  const { timeSeconds } = wb.transport.get();
  const places = bindPlaces(character, skin, timeSeconds);
  const replaces = skin.attachments ? ` Replaces the weights of ${skin.name}.` : '';
  return toolDialog<AutoWeights>(wb, close, {
    title: TITLE,
    // The result is visible in the viewport.
    kind: 'is-aside',
    about:
      'Heat diffusion from the bones: each vertex follows the nearest bone it can see through the ' +
      `inside, blended where bones meet.${replaces}`,
    asked: asked(places),
    command: autoWeights,
    args: (answers) => ({
      characterId: character.id,
      skin: character.shownSkin,
      timeSeconds,
      mostInfluences: answers.number('most'),
      bind: places.find((place) => place === answers.choice('bind')) ?? places[0],
    }),
    *steps(document, args) {
      const made = yield* autoWeightsSteps(document, args);
      const warning = idleText(skeleton, made.idle);
      return { change: made.document, text: weightsText(made), ...(warning && { warning }) };
    },
  });
}

function asked(places: readonly BindPlace[]): Asked[] {
  const most: Asked = askNumber('most', 'Max joints per vertex', USUAL_INFLUENCES);
  if (places.length < 2) return [most];
  const options = places.map((place) => [place, PLACES[place]] as const);
  return [most, askChoice('bind', 'Bind', options, { value: places[0] })];
}

/** Further names are counted. */
const MAX_NAMED = 4;

/** `8 of 23 joints move nothing: their bones lie outside the skin, or others’ lie nearer (head, …).` */
export function idleText(skeleton: Skeleton, idle: readonly number[]): string {
  if (!idle.length) return '';
  const { length } = skeleton.joints;
  const named = idle.slice(0, MAX_NAMED).map((joint) => jointName(skeleton, joint));
  const names = [...named, ...(idle.length > MAX_NAMED ? ['…'] : [])].join(', ');
  const isOne = idle.length === 1;
  const move = isOne ? 'moves nothing: its bone is' : 'move nothing: their bones are';
  return `${idle.length} of ${plural(length, 'joint')} ${move} outside the skin, or others are closer (${names}).`;
}

/** `2,019 vertices follow 27 joints, 2.3 per vertex on average. 4 vertices see no bone; weighted by distance.` */
function weightsText({ skin, moving, byDistance }: Pick<AutoWeighted, 'skin' | 'moving' | 'byDistance'>): string {
  const each = moving > 1 ? `, ${shown(meanInfluences(skin), 1)} per vertex on average` : '';
  const apart = byDistance
    ? ` ${plural(byDistance, 'vertex', 'vertices')} see${byDistance === 1 ? 's' : ''} no bone; weighted by distance.`
    : '';
  return `${plural(vertexCount(skin), 'vertex', 'vertices')} follow ${plural(moving, 'joint')}${each}.${apart}`;
}
