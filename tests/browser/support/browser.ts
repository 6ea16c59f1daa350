import { type Browser, chromium } from "playwright-core";

const kChromium = process.env.CHROMIUM_BIN ?? "/usr/bin/chromium";

/**
 * What Chromium leaves out. The first two draw the list under the address bar, which nobody sees here, by pages of
 * their own: most of the work of opening a page. The others are of Playwright's own list, as the last flag counts.
 */
const kLeftOut = [
  "WebUIOmniboxPopup",
  "WebUIOmniboxAimPopup",
  "AvoidUnnecessaryBeforeUnloadCheckSync",
  "BoundaryEventDispatchTracksNodeRemoval",
  "DestroyProfileOnBrowserClose",
  "GlobalMediaControls",
  "HttpsUpgrades",
  "MediaRouter",
  "OptimizationHints",
  "PaintHolding",
  "RenderDocument",
  "ThirdPartyStoragePartitioning",
  "Translate",
];

/** A browser of one's own. Colours are as they are in the picture: no colour profile before a screenshot. */
export function launch(more: readonly string[] = []): Promise<Browser> {
  const sandbox = process.getuid?.() === 0 ? ["--no-sandbox"] : [];
  const left = `--disable-features=${kLeftOut.join(",")}`;
  const args = [...sandbox, "--force-color-profile=srgb", left, ...more];
  return chromium.launch({ executablePath: kChromium, headless: true, args });
}

let shared: Browser | undefined;

/** The browser of all files, which ends with this process. Contexts keep pages apart, so nothing is left for the next. */
export async function sharedBrowser(): Promise<Browser> {
  if (!shared?.isConnected()) shared = await launch();
  return shared;
}
