#include "tests/realtime/stage.hpp"

#include <algorithm>
#include <cmath>

#include "welkin/base/tone.hpp"

namespace welkin::realtime::test {

Stage::Stage(int width, int height, gl::ContextKind kind)
    : context(kind), gl(gl::loadApi(context.loader())), sky(std::make_unique<Renderer>(context.loader())),
      target_(gl, gl::Texture::Kind::plane, gl::kRgba32F, width, height, 0, gl::Filter::nearest, gl::Addressing::clamp,
              nullptr),
      framebuffer_(gl) {
  const gl::Texture* targets[] = {&target_};
  framebuffer_.target(targets);
  gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &name_);
}

Frame Stage::frame(const Scene& scene) const { return frameOf(scene.camera, target_.width(), target_.height()); }

Image Stage::draw(const Scene& scene, int frames, double time) {
  sky->setScene(scene);
  view.reset();
  Frame f = frame(scene);
  f.time = time;
  for (int i = 1; i < frames; ++i) draw(view, f);
  return draw(view, f);
}

Image Stage::draw(View& drawn, Frame f, const glm::vec4& clear) {
  f.framebuffer = static_cast<unsigned>(name_);
  const int width = target_.width(), height = target_.height();
  gl.BindFramebuffer(GL_FRAMEBUFFER, f.framebuffer);
  gl.ClearColor(clear.x, clear.y, clear.z, clear.w);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  sky->render(drawn, f);
  std::vector<float> rgba(static_cast<std::size_t>(width) * height * 4);
  gl.BindFramebuffer(GL_FRAMEBUFFER, f.framebuffer);
  gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
  gl.check("reading a picture back");
  Image image(width, height, 4);
  for (int y = 0; y < height; ++y)
    std::copy_n(rgba.data() + static_cast<std::size_t>(height - 1 - y) * width * 4, width * 4, image.at(0, y));
  return image;
}

gl::Texture Stage::depth(const std::vector<float>& texels) const {
  return gl::Texture(gl, gl::Texture::Kind::plane, gl::kR32F, target_.width(), target_.height(), 0, gl::Filter::nearest,
                     gl::Addressing::clamp, texels.data());
}

Scene plainScene(LayerShape shape) {
  Scene scene;
  scene.quality = qualityPreset(QualityPreset::ultra);
  scene.quality.jitter = false;
  scene.layers[0].cloud.shape = shape;
  if (shape == LayerShape::nubis) scene.layers[0].cloud.thickness = 2500.0f;
  makeSmall(scene);
  return scene;
}

void makeSmall(Scene& scene) {
  scene.quality.preset = QualityPreset::low;  // by itself it only sizes the clip levels
  scene.noise.profile.baseSize = 64;
  scene.noise.baseShape.size = 64;
}

Image displayed(const Image& light) {
  Image rgb(light.width, light.height, 3);
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) std::copy_n(light.at(x, y), 3, rgb.at(x, y));
  const std::vector<std::uint8_t> bytes = displayBytes(rgb, {});
  for (std::size_t i = 0; i < bytes.size(); ++i) rgb.pixels[i] = static_cast<float>(bytes[i]) / 255.0f;
  return rgb;
}

double displayedPsnr(const Image& a, const Image& b) { return psnr(displayed(a), displayed(b)); }

Statistics statistics(const Image& light) {
  Statistics s{0.0, 0.0, 1e30, -1e30, true};
  double squares = 0.0;
  const double count = 3.0 * light.width * light.height;
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double v = light.at(x, y)[c];
        s.finite = s.finite && std::isfinite(v);
        s.mean += v / count;
        squares += v * v / count;
        s.least = std::min(s.least, v);
        s.most = std::max(s.most, v);
      }
  s.deviation = std::sqrt(std::max(squares - s.mean * s.mean, 0.0));
  return s;
}

double roughness(const Image& light) {
  double steps = 0.0, sum = 0.0;
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x + 1 < light.width; ++x) {
      steps += std::abs(light.at(x + 1, y)[1] - light.at(x, y)[1]);
      sum += light.at(x, y)[1];
    }
  return steps / sum;
}

}  // namespace welkin::realtime::test
