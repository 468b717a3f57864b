#!/usr/bin/env bash
# four_hosts.sh PROGRAM SCENE FOLDER: runs SCENE (100 000 particles) on four hosts of this machine,
# each a network namespace with an address of its own, connected by a bridge; TCP with keys between
# them.
# Results are in FOLDER/out. Needs root and iproute2; exits with 77 if these are missing.
set -euo pipefail

program=$1 scene=$2 folder=$3
id=lux$$

command -v ip >/dev/null && [ "$(id -u)" -eq 0 ] && ip netns add "$id-try" 2>/dev/null || exit 77
ip netns del "$id-try"

clean_up() {
  kill $(jobs -p) 2>/dev/null || true
  for host in 1 2 3 4; do ip netns del "$id-$host" 2>/dev/null || true; done
  ip link del "$id" 2>/dev/null || true
}
trap clean_up EXIT

ip link add "$id" type bridge 2>/dev/null || exit 77
ip link set "$id" up
cluster=$folder/hosts.toml
printf '[run]\nname = "hosts"\nscene = "%s"\nparticles = 100_000\nout = "%s"\n' \
  "$scene" "$folder/out" >"$cluster"
printf '[keys]\nfolder = "keys"\n' >>"$cluster"
names=(none a b c controller)
for host in 1 2 3 4; do
  ip netns add "$id-$host"
  ip link add "$id-v$host" type veth peer name eth0 netns "$id-$host"
  ip link set "$id-v$host" master "$id" up
  ip -n "$id-$host" addr add "10.77.0.$host/24" dev eth0
  ip -n "$id-$host" link set eth0 up
  ip -n "$id-$host" link set lo up
  printf '[[host]]\nname = "h%s"\naddress = "10.77.0.%s"\n' "$host" "$host" >>"$cluster"
  printf '[[node]]\nname = "%s"\nhost = "h%s"\n' "${names[$host]}" "$host" >>"$cluster"
done
printf 'role = "controller"\n' >>"$cluster"  # of the last node

"$program" keygen --cluster "$cluster" >/dev/null
for host in 1 2 3; do
  ip netns exec "$id-$host" "$program" node --config "$cluster" --name "${names[$host]}" &
done
timeout 120 ip netns exec "$id-4" "$program" node --config "$cluster" --name controller
wait
