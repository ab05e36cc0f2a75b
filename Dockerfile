# modeler with a C compiler, in an image that is not run as root. Nothing here has built it.
#
#   docker build -t modeler .
#   docker run --rm -v "$PWD:/srv/work" --user "$(id -u):$(id -g)" modeler derive wrist

FROM python:3.13-slim AS wheel
WORKDIR /build
COPY . .
RUN python -m pip install --no-cache-dir -c constraints.txt build hatchling hatch-fancy-pypi-readme \
    && python -m build --wheel --no-isolation --outdir /dist

FROM python:3.13-slim
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install -y --no-install-recommends gcc libc6-dev make \
    && rm -rf /var/lib/apt/lists/*
COPY constraints.txt /dist/
COPY --from=wheel /dist /dist
RUN python -m pip install --no-cache-dir -c /dist/constraints.txt /dist/*.whl \
    && useradd --create-home --uid 1000 modeler \
    && install -d -m 1777 /srv/work /srv/cache
ENV MODELER_CACHE=/srv/cache
ENV MPLCONFIGDIR=/srv/cache/matplotlib
USER 1000
WORKDIR /srv/work
ENTRYPOINT ["modeler"]
CMD ["--help"]
