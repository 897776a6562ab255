#!/usr/bin/env bash
# A second machine, played by a network namespace: with TLS and a token it gets in, without them it does not.
#   bash namespace.sh BTR PYTHON
# Says why and ends with 77 where namespaces may not be made.
set -u
btr=$1 python=$2
name=uchilsim$$
folder=$(mktemp -d)
server=
cleanup() {
  [ -n "$server" ] && kill "$server" && wait "$server"
  ip netns del "$name" 2> /dev/null
  ip link del "h$name" 2> /dev/null
  rm -rf "$folder"
}
if ! ip netns add "$name" 2> "$folder/why"; then
  echo "skipped: no network namespace can be made here ($(head -1 "$folder/why"))"
  rm -rf "$folder"
  exit 77
fi
trap cleanup EXIT
fail() { echo "FAILED: $*"; exit 1; }
if ! ip link add "h$name" type veth peer name eth0 netns "$name" 2> "$folder/why"; then
  echo "skipped: no link into a namespace can be made here ($(head -1 "$folder/why"))"
  exit 77
fi
here=10.213.$(($$ / 250 % 250)).$(($$ % 250 + 1)) there=10.213.$(($$ / 250 % 250)).$((($$ + 1) % 250 + 1))
ip addr add "$here/16" dev "h$name" && ip link set "h$name" up || fail "no address"
ip -n "$name" addr add "$there/16" dev eth0 && ip -n "$name" link set eth0 up || fail "no address in the namespace"

openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 1 -subj /CN=test \
  -addext "subjectAltName=IP:$here" -keyout "$folder/key.pem" -out "$folder/cert.pem" 2> /dev/null || fail "no certificate"
token=$(od -An -N 16 -tx1 /dev/urandom | tr -d ' \n')
(umask 077 && echo "drive $token lab" > "$folder/tokens")

"$btr" serve --address "$here" --port 0 > /dev/null 2> "$folder/err" && fail "it listens to others without TLS and token"
"$btr" --json serve --address "$here" --port 0 --tls "$folder/cert.pem" "$folder/key.pem" --token-file "$folder/tokens" \
  > "$folder/out" 2> "$folder/err" &
server=$!
# The server says where it listens in its first line.
while ! grep -q '"port"' "$folder/out"; do
  kill -0 "$server" 2> /dev/null || fail "the server ended: $(cat "$folder/err")"
  read -rt 0.1 < <(:) || true
done
port=$(grep -o '"port": *[0-9]*' "$folder/out" | grep -o '[0-9]*$')

ip netns exec "$name" "$python" - "$here:$port" "$token" "$folder/cert.pem" <<'P' || fail "from the second machine"
import sys
import uchilsim
address, token, certificate = sys.argv[1:]
with uchilsim.Client(address, token, certificate) as client:
    assert client.wait().role == "drive"
    with client.open("robots/ers7.wrl") as world:
        assert world.step(10).period == 10
for wrong, given, error in ((None, certificate, uchilsim.NoAccess), (token[:-1] + "-", certificate, uchilsim.NoAccess),
                            (token, None, uchilsim.Unreachable)):
    with uchilsim.Client(address, wrong, given) as client:
        try:
            client.info()
        except error as said:
            print(type(said).__name__, said)
        else:
            raise SystemExit(f"it let in {wrong} {given}")
P
echo passed
