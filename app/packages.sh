# Debian 12 packages that UCHILSIM needs, in one place for app/start, tests/run and .ci/run.
BUILD_PACKAGES="g++ make cmake ninja-build ccache pkg-config
  qt6-base-dev libqt6opengl6-dev qt6-charts-dev qt6-svg-dev libqt6svg6 libgl-dev libegl-dev libopenscenegraph-dev
  libode-dev libeigen3-dev libceres-dev libsqlitecpp-dev libsqlite3-dev nlohmann-json3-dev libcli11-dev
  libtinyxml2-dev libassimp-dev libboost-dev zlib1g-dev libssl-dev pandoc
  libgrpc++-dev libprotobuf-dev protobuf-compiler protobuf-compiler-grpc python3-grpcio python3-protobuf python3-numpy
  libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-calib3d-dev libopencv-videoio-dev
  libopenmpi-dev openmpi-bin"
WINDOW_PACKAGES="breeze-icon-theme fonts-dejavu-core libgl1-mesa-dri libegl-mesa0 libglx-mesa0"
TEST_PACKAGES="clang-format libgtest-dev libgmock-dev libmujoco-dev xvfb xauth xdotool sqlite3 python3-minimal opencv-doc
  openssl iproute2 slurm-wlm munge parallel rsync openssh-server"
CLANG_PACKAGES="clang libclang-rt-14-dev"

# Installs those of its arguments that are not there yet, in one apt call.
install_missing() {
  local missing=() package
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local sudo=""
  [ "$(id -u)" = 0 ] || sudo=sudo
  echo "Installing: ${missing[*]}"
  $sudo apt-get update -qq
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
}
