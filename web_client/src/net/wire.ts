import type { MessageInitShape } from "@bufbuild/protobuf";
import type { ClientMessageSchema } from "./gen/volcast/v1/session_pb";

export type Body = NonNullable<MessageInitShape<typeof ClientMessageSchema>["body"]>;

/** The connection, as a view's conversation needs it. */
export interface Wire {
  /** The server has answered the hello of this connection. */
  readonly greeted: boolean;
  /** False where the message was not handed to an open connection. */
  send(body: Body): boolean;
  /** A number that no view, and no question, of this page has had. */
  newNumber(): number;
}
