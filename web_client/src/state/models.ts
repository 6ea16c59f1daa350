import {
  Integrator,
  type Layer,
  MeshEvaluator,
  RayModel,
  Scale_Kind,
} from "../net/gen/volcast/v1/scene_pb";

/** Which of a layer's two maps: of its field, or of its second field. */
export type Slot = "first" | "second";

/** What the panel has to know of a ray model; what a model draws is the server's matter. */
export interface ModelFacts {
  readonly name: string;
  /** One line for people. */
  readonly meaning: string;
  readonly colours: boolean;
  readonly extinction: boolean;
  /** Bends to a headlight. */
  readonly lit: boolean;
  /** What a second field gives, where it has a meaning. */
  readonly second: "density" | "colour" | undefined;
  /** From cheap to exact; with a single one there is nothing to choose. */
  readonly integrators: readonly Integrator[];
  /** Rays gather it, so that a mesh can be walked or projected. */
  readonly gathered: boolean;
}

const kOnlyExact = [Integrator.EXACT];
const kLine = [Integrator.FRONT, Integrator.ENDS, Integrator.EXACT];
const kPlain = {
  colours: true,
  extinction: false,
  lit: false,
  second: undefined,
  integrators: kOnlyExact,
  gathered: true,
} as const;

const kFacts: ReadonlyMap<RayModel, ModelFacts> = new Map([
  [
    RayModel.SURFACE,
    {
      ...kPlain,
      name: "Surface",
      meaning: "The nearest boundary of the data.",
      lit: true,
      gathered: false,
    },
  ],
  [
    RayModel.WIREFRAME,
    {
      ...kPlain,
      name: "Wireframe",
      meaning: "The nearest boundary with the edges of its cells.",
      lit: true,
      gathered: false,
    },
  ],
  [
    RayModel.MIP,
    { ...kPlain, name: "Maximum", meaning: "The colour of the largest value along each ray." },
  ],
  [
    RayModel.MINIP,
    { ...kPlain, name: "Minimum", meaning: "The colour of the smallest value along each ray." },
  ],
  [
    RayModel.MIP_COLOUR,
    {
      ...kPlain,
      name: "Max colour",
      meaning: "The most red, green and blue along each ray, each by itself.",
      integrators: [Integrator.ENDS, Integrator.EXACT],
    },
  ],
  [
    RayModel.XRAY,
    {
      ...kPlain,
      name: "X-ray",
      meaning: "White light, and what is left of it behind all that absorbs.",
      colours: false,
      extinction: true,
      second: "density" as const,
      integrators: kLine,
    },
  ],
  [
    RayModel.SPLAT,
    {
      ...kPlain,
      name: "Splat",
      meaning: "All colours along each ray added up; nothing absorbs.",
      integrators: kLine,
    },
  ],
  [
    RayModel.ISOSURFACE,
    {
      ...kPlain,
      name: "Isosurface",
      meaning: "The nearest point with one of the given values.",
      lit: true,
      second: "colour" as const,
    },
  ],
  [
    RayModel.VOLUME,
    {
      ...kPlain,
      name: "Volume",
      meaning: "Light emitted and absorbed along each ray.",
      extinction: true,
      second: "density" as const,
      integrators: [
        Integrator.AVERAGE,
        Integrator.LINEAR_OPACITY,
        Integrator.PSI_TABLE,
        Integrator.PSI,
        Integrator.PREINTEGRATED,
        Integrator.EXACT,
      ],
    },
  ],
  [
    RayModel.CROSS_SECTIONS,
    {
      ...kPlain,
      name: "Sections",
      meaning: "Planes across the axes of the data, coloured by its values.",
      gathered: false,
    },
  ],
]);

const kVolumeOfVoxels = [
  Integrator.AVERAGE,
  Integrator.PREINTEGRATED,
  Integrator.LINEAR_OPACITY,
  Integrator.PSI,
  Integrator.EXACT,
  Integrator.ADAPTIVE,
];

/** What can be chosen for voxels; empty where there is a single way. */
export function voxelIntegratorsOf(model: RayModel): readonly Integrator[] {
  if (model === RayModel.VOLUME || model === RayModel.UNSPECIFIED) return kVolumeOfVoxels;
  const { integrators } = factsOf(model);
  if (integrators === kLine) return [...kLine, Integrator.ADAPTIVE];
  return integrators.length > 1 ? integrators : [];
}

const kUnknown: ModelFacts = { ...kPlain, name: "", meaning: "" };

/** A model that a newer server has keeps its number for a name. */
export function factsOf(model: RayModel): ModelFacts {
  const known = kFacts.get(model === RayModel.UNSPECIFIED ? RayModel.VOLUME : model);
  return known ?? { ...kUnknown, name: `Model ${model}` };
}

/** By the server's names, so that plans, frames and the command line say the same. */
export const kIntegratorNames: Readonly<Record<Integrator, string>> = {
  [Integrator.AUTO]: "auto",
  [Integrator.AVERAGE]: "average",
  [Integrator.LINEAR_OPACITY]: "linear_opacity",
  [Integrator.PSI_TABLE]: "psi_table",
  [Integrator.PSI]: "psi",
  [Integrator.PREINTEGRATED]: "preintegrated",
  [Integrator.EXACT]: "exact",
  [Integrator.FRONT]: "front",
  [Integrator.ENDS]: "ends",
  [Integrator.ADAPTIVE]: "adaptive",
};

export const kIntegratorLabels: Readonly<Record<Integrator, string>> = {
  [Integrator.AUTO]: "As the wish asks",
  [Integrator.AVERAGE]: "Average",
  [Integrator.LINEAR_OPACITY]: "Linear opacity",
  [Integrator.PSI_TABLE]: "Psi, from a table",
  [Integrator.PSI]: "Psi, closed form",
  [Integrator.PREINTEGRATED]: "Pre-integrated",
  [Integrator.EXACT]: "Exact",
  [Integrator.FRONT]: "Front end",
  [Integrator.ENDS]: "Both ends",
  [Integrator.ADAPTIVE]: "Adaptive steps",
};

export const kEvaluatorLabels: Readonly<Record<MeshEvaluator, string>> = {
  [MeshEvaluator.AUTO]: "Whatever is faster",
  [MeshEvaluator.WALK]: "Walk from cell to cell",
  [MeshEvaluator.PROJECTION]: "Project the cells",
  [MeshEvaluator.PROJECTION_FACES]: "Project all faces",
};

/** The evaluators that draw `model` with `integrator`. */
export function evaluatorsOf(model: RayModel, integrator: Integrator): readonly MeshEvaluator[] {
  if (!factsOf(model).gathered) return [MeshEvaluator.AUTO];
  const byEnds = integrator === Integrator.ENDS || integrator === Integrator.AUTO;
  const faces =
    model === RayModel.MIP || model === RayModel.MINIP || (model === RayModel.MIP_COLOUR && byEnds);
  const all = [MeshEvaluator.AUTO, MeshEvaluator.WALK, MeshEvaluator.PROJECTION];
  return faces ? [...all, MeshEvaluator.PROJECTION_FACES] : all;
}

const isTriangles = (model: RayModel): boolean =>
  model === RayModel.SURFACE || model === RayModel.WIREFRAME;

/** The part that the second field plays in this layer. */
export function secondPart(layer: Layer | undefined): ModelFacts["second"] {
  return layer?.densityField ? factsOf(layer.model).second : undefined;
}

/** True where the picture depends on this map's extinction. */
export function usesExtinction(layer: Layer | undefined, slot: Slot = "first"): boolean {
  if (!layer || layer.shader?.code || !factsOf(layer.model).extinction) return false;
  return (secondPart(layer) === "density") === (slot === "second");
}

/** True where the picture depends on this map's colours. */
export function usesColours(layer: Layer | undefined, slot: Slot = "first"): boolean {
  if (!layer) return slot === "first";
  if (layer.shader?.code) return false;
  if (isTriangles(layer.model)) return slot === "first" && layer.coloured;
  if (!factsOf(layer.model).colours) return false;
  return (secondPart(layer) === "colour") === (slot === "second");
}

/** Models that draw several channels of a volume together. */
export const kSeveral: ReadonlySet<RayModel> = new Set([
  RayModel.UNSPECIFIED,
  RayModel.VOLUME,
  RayModel.MIP,
  RayModel.MINIP,
  RayModel.XRAY,
]);

/** Models that show what a user's code emits. */
export const kRunsCode: ReadonlySet<RayModel> = new Set([
  RayModel.UNSPECIFIED,
  RayModel.VOLUME,
  RayModel.MIP,
  RayModel.MINIP,
  RayModel.CROSS_SECTIONS,
]);

/** What of a layer cannot stay with another model: the new model's own choices serve it. */
export function fittedTo(layer: Layer, model: RayModel): Partial<Layer> {
  const { integrators } = factsOf(model);
  const choosable = integrators.length > 1;
  const integrator =
    choosable && integrators.includes(layer.integrator) ? layer.integrator : Integrator.AUTO;
  const evaluator = evaluatorsOf(model, integrator).includes(layer.evaluator)
    ? layer.evaluator
    : MeshEvaluator.AUTO;
  const channels = kSeveral.has(model) ? layer.channels : [];
  const shader = kRunsCode.has(model) ? layer.shader : undefined;
  return { model, integrator, evaluator, channels, shader };
}

export const kScaleLabels: Readonly<Record<Scale_Kind, string>> = {
  [Scale_Kind.LINEAR]: "Linear",
  [Scale_Kind.LOG]: "Logarithmic",
  [Scale_Kind.POWER]: "Power",
};
