const kKey = "volcast.access";

/** The access token in a fragment (`#access=TOKEN`), and the fragment without it. */
export function accessIn(fragment: string): { readonly access?: string; readonly rest: string } {
  const parts = fragment.replace(/^#/, "").split("&");
  const token = parts.find((part) => part.startsWith("access="));
  const rest = parts.filter((part) => part && part !== token).join("&");
  return { access: token?.slice("access=".length), rest: rest && `#${rest}` };
}

/**
 * The access token of this tab: from its address, else from before a reload. The address forgets
 * it, so that it isn't given away with what the page shows.
 */
export function takeAccess(): string {
  const { access, rest } = accessIn(location.hash);
  if (access === undefined) return sessionStorage.getItem(kKey) ?? "";
  sessionStorage.setItem(kKey, access);
  history.replaceState(null, "", rest || location.pathname + location.search);
  return access;
}
