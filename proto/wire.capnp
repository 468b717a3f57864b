# The frames of Luxodus. PROTOCOL.md says who sends what, when, and why; messages.hpp what each field
# means. Numbers are never reused; new fields come at the end. A frame is one Envelope, one segment
# long, and behind it a chunk of a message: a Message, one segment long, and behind that the
# payload, which no schema describes.
@0xb3c1f5a2d7e84690;

using Cxx = import "/capnp/c++.capnp";
$Cxx.namespace("luxodus::wire");

# Made anew by every node that a frame passes.
struct Envelope {
  from @0 :UInt16;
  source @1 :UInt16;
  destination @2 :UInt16;
  kind @3 :UInt8;
  hops @4 :UInt8;
  fromIncarnation @5 :UInt64;
  toIncarnation @6 :UInt64;
  idNode @7 :UInt16;
  grantKind @8 :UInt8;
  grantHopClass @9 :UInt8;
  chunk @10 :UInt32;
  idIncarnation @11 :UInt64;
  idSequence @12 :UInt64;
  epoch @13 :UInt64;
  sent @14 :UInt64;
  grantLimit @15 :UInt64;
  totalBytes @16 :UInt32;
  chunkBytes @17 :UInt32;
  fromActor @18 :UInt8;
  toActor @19 :UInt8;
}

struct Message {
  union {
    hello @0 :Identity;
    welcome @1 :Identity;
    refuse @2 :Refuse;
    bye @3 :Void;
    beat @4 :Beat;
    linkChanges @5 :List(LinkChange);
    fetchObject @6 :FetchObject;
    objectFound @7 :FetchAnswer;
    objectNotHere @8 :FetchAnswer;
    requestLease @9 :RequestLease;
    leaseGranted @10 :LeaseGranted;
    leasesFenced @11 :List(UInt64);
    flush @12 :Flush;
    flushTaken @13 :Void;
    flushRefused @14 :FlushRefused;
    roundOpened @15 :RoundOpened;
    runEnded @16 :RunEnded;
    profileCounted @17 :ProfileCounted;
    askStatus @18 :Void;
    statusAnswered @19 :Void;
    enterPhase @20 :EnterPhase;
    flushSlice @21 :FlushSlice;
    sliceHeld @22 :Void;
    flushDecided @23 :FlushDecided;
    flushSettled @24 :FlushSettled;
    askTotals @25 :AskTotals;
    totalsTold @26 :TotalsTold;
    askState @27 :UInt64;
    stateTold @28 :UInt64;
    showTotals @29 :ShowTotals;
    totalsShown @30 :TotalsShown;
    fluxSaved @31 :FluxSaved;
    appMessage @32 :AppMessage;
    appBulk @33 :AppMessage;
  }
}

struct Identity {
  protocolVersion @0 :UInt16;
  node @1 :UInt16;
  level @2 :UInt8;
  sceneHash @3 :UInt64;
  topologyHash @4 :UInt64;
  runId @5 :UInt64;
  fingerprint @6 :UInt64;
  build @7 :Text;
  isa @8 :Text;
  results @9 :Text;
}

struct Refuse {
  reason @0 :UInt8;
  text @1 :Text;
}

struct Beat {
  viewHash @0 :UInt64;
  pools @1 :List(PoolState);
}

struct PoolState {
  kind @0 :UInt8;
  hopClass @1 :UInt8;
  sent @2 :UInt64;
  limit @3 :UInt64;
}

struct LinkChange {
  a @0 :UInt16;
  b @1 :UInt16;
  version @2 :UInt32;
}

struct FetchObject {
  object @0 :UInt64;
  budgetUs @1 :UInt64;
  attempt @2 :UInt16;
}

struct FetchAnswer {
  object @0 :UInt64;
  answeredBy @1 :UInt16;
}

struct RequestLease {
  batches @0 :UInt32;
}

struct LeaseGranted {
  firstLease @0 :UInt64;
  round @1 :UInt32;
  firstBatch @2 :UInt64;
  batches @3 :UInt32;
  durationMs @4 :UInt32;
  state @5 :UInt64;
}

struct Flush {
  round @0 :UInt32;
  payloadHash @1 :UInt64;
  leases @2 :List(UInt64);
  sliceHashes @3 :List(UInt64);
}

struct FlushRefused {
  fenced @0 :List(UInt64);
  text @1 :Text;
}

struct RoundOpened {
  round @0 :UInt32;
  batches @1 :UInt64;
  state @2 :UInt64;
}

struct RunEnded {
  round @0 :UInt32;
  text @1 :Text;
}

struct ProfileCounted {
  particles @0 :UInt64;
  objects @1 :UInt32;
}

struct EnterPhase {
  phase @0 :UInt8;
  durationMs @1 :UInt32;
}

struct FlushSlice {
  payloadHash @0 :UInt64;
}

struct FlushDecided {
  node @0 :UInt16;
  taken @1 :Bool;
  incarnation @2 :UInt64;
  sequence @3 :UInt64;
  sliceHash @4 :UInt64;
}

struct FlushSettled {
  whole @0 :Bool;
}

struct AskTotals {
  gather @0 :UInt32;
  first @1 :UInt64;
}

struct TotalsTold {
  gather @0 :UInt32;
  first @1 :UInt64;
  next @2 :UInt64;
}

struct ShowTotals {
  show @0 :UInt32;
  piece @1 :UInt32;
}

struct TotalsShown {
  show @0 :UInt32;
  piece @1 :UInt32;
  pieces @2 :UInt32;
  stopped @3 :UInt8;
  over @4 :Bool;
  first @5 :UInt64;
  next @6 :UInt64;
  batches @7 :UInt64;
  tracedUs @8 :UInt64;
  untimedBatches @9 :UInt64;
  untimedRays @10 :UInt64;
}

struct FluxSaved {
  show @0 :UInt32;
  fault @1 :Text;
}

struct AppMessage {
  from @0 :UInt64;
  to @1 :UInt64;
  schema @2 :UInt64;
  answer @3 :Bool;
}
