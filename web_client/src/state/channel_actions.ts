import { create } from "@bufbuild/protobuf";
import {
  type ChannelMap,
  ChannelMapSchema,
  RangeSchema,
  RayModel,
} from "../net/gen/volcast/v1/scene_pb";
import { DatasetKind, type FieldInfo } from "../net/gen/volcast/v1/session_pb";
import { resolved } from "../transfer/drawn_map";
import { kMaxDrawnOpacity, opacityFromExtinction } from "../transfer/opacity";
import { type Colour, fromHex } from "../transfer/srgb";
import { changeLayer, usualRangeOf } from "./actions";
import type { AppState } from "./app_state";
import { kSeveral } from "./models";
import { mapMessage, mapOf } from "./scene_message";

/** That a layer draws together at most; the server's limit. */
export const kMostChannels = 4;

/** One channel as it is edited here: one colour that fades in over a range. */
export interface ChannelLook {
  readonly colour: Colour;
  readonly first: number;
  readonly last: number;
  /** Over the reference length, at the end of the range. */
  readonly opacity: number;
}

const kColours = ["#ff4040", "#40d040", "#5080ff", "#ffd040"].map(
  (hex) => fromHex(hex) ?? { r: 1, g: 1, b: 1 },
);
const kUsualOpacity = 0.6;

/** Whether there are channels to draw together. */
export function canDrawTogether(state: AppState): boolean {
  const dataset = state.dataset.value;
  const model = state.layer.value?.model ?? RayModel.UNSPECIFIED;
  const several = (dataset?.fields.length ?? 0) > 1;
  return dataset?.kind === DatasetKind.VOLUME && several && kSeveral.has(model);
}

/** What the ends of a channel's map say. */
export function lookOf(channel: ChannelMap, referenceLength: number): ChannelLook {
  const map = mapOf(channel.transferFunction);
  const end = map.reduce((a, b) => (b.extinction > a.extinction ? b : a), map[0] ?? kNoPoint);
  const [first, last] = [map[0]?.value ?? 0, map[map.length - 1]?.value ?? 1];
  return {
    colour: end.colour,
    // A map that falls was drawn from high values to low ones.
    first: end.value === last ? first : last,
    last: end.value === last ? last : first,
    opacity: opacityFromExtinction(end.extinction, referenceLength),
  };
}

const kNoPoint = { value: 1, colour: { r: 1, g: 1, b: 1 }, extinction: 0 };

function channelOf(
  field: string,
  look: ChannelLook,
  hidden: boolean,
  distance: number,
): ChannelMap {
  const colours = [
    { position: 0, colour: { r: 0, g: 0, b: 0 } },
    { position: 1, colour: look.colour },
  ];
  const opacity = Math.min(kMaxDrawnOpacity, Math.max(0, look.opacity));
  const opacities = [
    { position: 0, opacity: 0 },
    { position: 1, opacity },
  ];
  const map = resolved({ colours, opacities, degree: 1, distance }, look);
  return create(ChannelMapSchema, { field, hidden, transferFunction: mapMessage(map) });
}

function usualLook(field: FieldInfo, index: number): ChannelLook {
  const { min, max } = usualRangeOf(field);
  const [first, last] = max > min ? [min, max] : [min - 0.5, min + 0.5];
  const colour = kColours[index % kColours.length] ?? { r: 1, g: 1, b: 1 };
  return { colour, first, last, opacity: kUsualOpacity };
}

/** Draws the first channels of the volume together, or its field alone again. */
export function drawTogether(state: AppState, together: boolean): void {
  const fields = state.dataset.value?.fields.slice(0, kMostChannels) ?? [];
  const length = state.referenceLength.value;
  const channels = fields.map((f, i) => channelOf(f.name, usualLook(f, i), false, length));
  const code = state.layer.value?.shader?.code;
  if (together && code) state.codeDraft.value ??= code;
  // What several channels have no use for; each has an interval of its own.
  const rest = together ? { interval: undefined, shader: undefined } : {};
  changeLayer(state, { ...rest, channels: together ? channels : [] });
}

/** Changes how a channel looks; a range without a width is not taken. */
export function changeChannel(
  state: AppState,
  index: number,
  part: Partial<ChannelLook & { hidden: boolean }>,
  gesture?: string,
): void {
  const length = state.referenceLength.value;
  const channels = state.layer.value?.channels ?? [];
  const channel = channels[index];
  if (!channel) return;
  const { hidden = channel.hidden, ...rest } = part;
  const look = { ...lookOf(channel, length), ...rest };
  if (look.first === look.last) return;
  const seen = Object.keys(rest).length > 0;
  const map = seen ? channelOf(channel.field, look, hidden, length) : { ...channel, hidden };
  const next = create(ChannelMapSchema, { ...map, interval: channel.interval });
  changeLayer(state, { channels: channels.map((c, i) => (i === index ? next : c)) }, gesture);
}

/** Draws a channel only where its values are in a range, or everywhere; a range in order is taken. */
export function limitChannel(
  state: AppState,
  index: number,
  range: { readonly min: number; readonly max: number } | undefined,
): void {
  const channels = state.layer.value?.channels ?? [];
  if (range && !(range.min <= range.max)) return;
  const interval = range && create(RangeSchema, range);
  const limited = (channel: ChannelMap): ChannelMap =>
    create(ChannelMapSchema, { ...channel, interval });
  changeLayer(state, { channels: channels.map((c, i) => (i === index ? limited(c) : c)) });
}
