# The messages of ping_pong.cpp: a schema of its own, of which the runtime knows nothing.
@0xd3a2b6f1c4e58a97;

using Cxx = import "/capnp/c++.capnp";
$Cxx.namespace("example");

struct Ping {
  round @0 :UInt32;
  text @1 :Text;
}
