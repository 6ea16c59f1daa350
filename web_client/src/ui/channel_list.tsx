import { endGesture } from "../state/actions";
import type { AppState } from "../state/app_state";
import {
  canDrawTogether,
  changeChannel,
  drawTogether,
  limitChannel,
  lookOf,
} from "../state/channel_actions";
import { percentileOf } from "../transfer/percentiles";
import { fromHex, toHex } from "../transfer/srgb";
import { formatNumber, formatValue } from "./format";
import { Check, NumberField } from "./inputs";

interface Props {
  readonly state: AppState;
}

/** Which values of a channel are drawn. */
function ChannelInterval({ state, index }: Props & { readonly index: number }) {
  const channel = state.layer.value?.channels[index];
  if (!channel) return null;
  const { first, last } = lookOf(channel, state.referenceLength.value);
  const usual = { min: Math.min(first, last), max: Math.max(first, last) };
  const now = channel.interval;
  return (
    <>
      <Check
        checked={now !== undefined}
        take={(on) => limitChannel(state, index, on ? usual : undefined)}
      >
        Only a range of values
      </Check>
      {now && (
        <div class="fields">
          <NumberField
            label="Lowest"
            text={formatValue(now.min, now.max - now.min, 6)}
            take={(min) => limitChannel(state, index, { min, max: now.max })}
          />
          <NumberField
            label="Highest"
            text={formatValue(now.max, now.max - now.min, 6)}
            take={(max) => limitChannel(state, index, { min: now.min, max })}
          />
        </div>
      )}
    </>
  );
}

/** One channel: shown or not, its colour, the range it fades in over, its opacity there. */
function ChannelRow({ state, index }: Props & { readonly index: number }) {
  const channel = state.layer.value?.channels[index];
  if (!channel) return null;
  const look = lookOf(channel, state.referenceLength.value);
  const span = Math.abs(look.last - look.first);
  const field = state.dataset.value?.fields.find((f) => f.name === channel.field);
  const from = percentileOf(field?.percentiles ?? [], 1);
  const to = percentileOf(field?.percentiles ?? [], 99);
  const fits = from !== undefined && to !== undefined && from !== to;
  return (
    <fieldset class="channel">
      <legend>
        <Check
          checked={!channel.hidden}
          take={(shown) => changeChannel(state, index, { hidden: !shown })}
        >
          {channel.field}
        </Check>
      </legend>
      <div class="point-fields channel-fields">
        <label class="number colour">
          <span>Colour</span>
          <input
            type="color"
            value={toHex(look.colour)}
            onInput={(e) => {
              const colour = fromHex(e.currentTarget.value);
              if (colour) changeChannel(state, index, { colour }, `channel colour ${index}`);
            }}
            onChange={() => endGesture(state)}
          />
        </label>
        <NumberField
          label="From"
          text={formatValue(look.first, span, 6)}
          take={(first) => changeChannel(state, index, { first })}
        />
        <NumberField
          label="To"
          text={formatValue(look.last, span, 6)}
          take={(last) => changeChannel(state, index, { last })}
        />
        <NumberField
          label="Opacity %"
          text={formatNumber(100 * look.opacity, 4)}
          take={(percent) => changeChannel(state, index, { opacity: percent / 100 })}
        />
        <button
          type="button"
          class="text-button"
          disabled={!fits}
          onClick={() => fits && changeChannel(state, index, { first: from, last: to })}
        >
          Auto
        </button>
      </div>
      <ChannelInterval state={state} index={index} />
    </fieldset>
  );
}

/** Several channels of a volume, each by a map of its own. */
export function ChannelList({ state }: Props) {
  const channels = state.layer.value?.channels ?? [];
  if (channels.length === 0 && !canDrawTogether(state)) return null;
  return (
    <section class="section" aria-labelledby="channels-heading">
      <div class="section-head">
        <h2 id="channels-heading">Channels</h2>
      </div>
      <Check checked={channels.length > 0} take={(together) => drawTogether(state, together)}>
        Draw channels together
      </Check>
      {channels.map((channel, index) => (
        <ChannelRow key={channel.field} state={state} index={index} />
      ))}
    </section>
  );
}
