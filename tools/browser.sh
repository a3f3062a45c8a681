#!/bin/bash
# Debian's Chromium for the tests that show a picture in a browser: installed when it is missing and may be.
# Without it those tests skip, and say so.
set -eu
if command -v chromium > /dev/null; then exit 0; fi
if [ "$(id -u)" != 0 ] || ! command -v apt-get > /dev/null; then
  echo "illuminant: no chromium here, so the tests with a browser skip"
  exit 0
fi
echo "illuminant: installing chromium for the tests with a browser"
export DEBIAN_FRONTEND=noninteractive
timeout 300 sh -c 'apt-get -qq update && apt-get -qq install -y --no-install-recommends chromium' > /dev/null 2>&1 ||
  echo "illuminant: chromium could not be installed, so the tests with a browser skip"
