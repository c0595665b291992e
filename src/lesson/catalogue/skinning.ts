/** Mistakes in skinning, morphs and normals. */
import { finer, inSkin, type Mistake } from './mistake.ts';

/** What becomes of an attachment to a joint that is not there. */
const BEYOND = [
  ['clamped', 'beyond the ends the last joint'],
  ['wrapped', 'beyond the ends from the other end'],
  ['left out', 'beyond the ends none'],
] as const;
const SKINNING_FORMULA = 'v′ = Σ wᵢ·Wᵢ·Bᵢ⁻¹·v';

export const SKINNING: readonly Mistake[] = [
  {
    code: 'no-inverse-binding',
    subject: 'skinning',
    sentence: () => 'Vertices are multiplied by W alone; it should be W·B⁻¹.',
    formula: SKINNING_FORMULA,
    variants: [inSkin('W', { binding: 'none' })],
  },
  {
    code: 'binding-not-inverted',
    subject: 'skinning',
    sentence: () => 'Vertices are multiplied by W·B; the binding matrix must be inverted.',
    formula: SKINNING_FORMULA,
    variants: [inSkin('W·B', { binding: 'not inverted' })],
  },
  {
    code: 'binding-order',
    subject: 'skinning',
    sentence: () => 'Vertices are multiplied by B⁻¹·W; it should be W·B⁻¹.',
    formula: SKINNING_FORMULA,
    variants: [inSkin('B⁻¹·W', { binding: 'before world' })],
  },
  {
    code: 'binding-rows',
    subject: 'skinning',
    sentence: () => 'Binding matrices are read as rows; each line of the file is a column: a, b, c and the position d.',
    formula: 'B = (a b c d), each a column',
    variants: [inSkin('B transposed', { bindingRows: true })],
  },
  {
    code: 'first-attachment-only',
    subject: 'skinning',
    sentence: (detail) => `Only one attachment of each vertex is used (${detail}); all of them move it.`,
    formula: SKINNING_FORMULA,
    variants: [
      inSkin('the first, with its own weight', { attachments: 'first' }),
      inSkin('the first, with weight 1', { attachments: 'first as whole' }),
      inSkin('the one with the largest weight, which it keeps', { attachments: 'largest' }),
      inSkin('the one with the largest weight, as weight 1', { attachments: 'largest as whole' }),
    ],
  },
  {
    code: 'first-four-attachments',
    subject: 'skinning',
    sentence: (detail) => `Only four attachments of each vertex are used (${detail}); a vertex may have any number.`,
    formula: SKINNING_FORMULA,
    variants: [
      inSkin('the first four, their weights not rescaled', { attachments: 'first four' }),
      inSkin('the first four, their weights rescaled to sum to 1', { attachments: 'first four normalised' }),
      finer(
        inSkin('the first four, their weights rescaled to sum to 1 where others are left out', {
          attachments: 'first four, cut ones normalised',
        }),
      ),
      inSkin('the four largest, their weights not rescaled', { attachments: 'largest four' }),
      inSkin('the four largest, their weights rescaled to sum to 1', { attachments: 'largest four normalised' }),
    ],
  },
  {
    code: 'weights-normalised',
    subject: 'skinning',
    sentence: () => 'Weights are normalised; they are used as the file gives them.',
    formula: SKINNING_FORMULA,
    variants: [inSkin('w / Σ w', { weights: 'normalised' })],
  },
  {
    code: 'bind-pose',
    subject: 'skinning',
    sentence: () => 'The skin is not moved: these are the vertices of the file.',
    formula: SKINNING_FORMULA,
    variants: [
      inSkin('with morphs', { bind: 'bind pose' }),
      finer(inSkin('without morphs', { bind: 'bind pose without morphs' })),
    ],
  },
  {
    code: 'morph-as-offset',
    subject: 'skinning',
    sentence: () => 'The values of morphs are added; they are absolute, so their difference from the base is.',
    formula: 'v = v₀ + Σ φₜ·(vₜ − v₀)',
    variants: [inSkin('v₀ + Σ φₜ·vₜ', { morph: 'offset' })],
  },
  {
    code: 'morph-after-skinning',
    subject: 'skinning',
    sentence: () => 'Morphs are added behind skinning; they change the base skin, which is skinned then.',
    formula: 'v = v₀ + Σ φₜ·(vₜ − v₀), then v′ = Σ wᵢ·Wᵢ·Bᵢ⁻¹·v',
    variants: [
      inSkin('', { morph: 'after' }),
      finer(inSkin('normals too, behind normalising', { morph: 'after normalising' })),
      finer(inSkin('positions only', { morph: 'after, positions only' })),
    ],
  },
  {
    code: 'normals-by-position-matrix',
    subject: 'skinning',
    sentence: () => 'Normals are moved by the whole matrix; a direction has no position, so no translation.',
    formula: 'n′ = Σ wᵢ·(Wᵢ·Bᵢ⁻¹)⁻ᵀ·n, normalised',
    variants: [
      inSkin('M·(n, 1)', { normals: 'as positions' }),
      inSkin('M⁻ᵀ·n with the translation', { normals: 'with translation' }),
    ],
  },
  {
    code: 'normals-unnormalised',
    subject: 'skinning',
    sentence: () => 'Normals are not normalised behind skinning.',
    formula: 'n′ / |n′|',
    variants: [inSkin('', { isNormalised: false })],
  },
  {
    code: 'normals-without-transpose',
    subject: 'skinning',
    sentence: (detail) => `Normals are multiplied by ${detail}; it should be the inverse transpose.`,
    formula: 'n′ = Σ wᵢ·(Wᵢ·Bᵢ⁻¹)⁻ᵀ·n, normalised',
    variants: [inSkin('M', { normals: 'matrix' }), inSkin('M⁻¹', { normals: 'inverse' })],
  },
  {
    code: 'joint-index-off',
    subject: 'skinning',
    sentence: (detail) => `Joints of attachments are off by one (${detail}); indices begin at 0.`,
    formula: 'joint 0 is the root',
    variants: [1, -1].flatMap((shift) =>
      BEYOND.map(([beyond, detail], i) => {
        const variant = inSkin(`${shift > 0 ? '+1' : '−1'}, ${detail}`, { joint: { shift, beyond } });
        return i > 0 ? finer(variant) : variant;
      }),
    ),
  },
];
