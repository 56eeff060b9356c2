#include "lychnite/app/session.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "lychnite/image/io.h"
#include "lychnite/scene/scene_file.h"
#include "scratch.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;

constexpr char kTriangle[] = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

void openNow(Session& session, const std::string& path) {
  session.open(path);
  session.finishLoading();
}

std::string allText(Session& session) {
  std::string text;
  for (const SessionMessage& message : session.takeMessages()) text += message.text + "\n";
  return text;
}

/// Waits until what the session writes is written.
void finishPictures(Session& session) {
  while (session.pictures().busy()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  session.poll(0);
}

TEST(Session, OpensABuiltInModelInGoodLight) {
  Session session;
  EXPECT_TRUE(session.empty());
  openNow(session, "stone");
  ASSERT_FALSE(session.empty());
  EXPECT_EQ(session.documentName(), "stone");
  EXPECT_EQ(session.state().scene.lights.size(), 2u);
  EXPECT_NO_THROW(validate(session.state().scene));
  EXPECT_FALSE(session.canUndo());
}

TEST(Session, ABadFileKeepsWhatThereWas) {
  const ScratchFolder scratch;
  std::ofstream(scratch / "bad.ply") << "not a mesh";
  std::ofstream(scratch / "bad.toml") << "object = 3";
  Session session;
  openNow(session, "stone");
  const std::string before = fingerprint(session.state());
  for (const std::string& file : {(scratch / "bad.ply").string(), (scratch / "bad.toml").string(),
                                  (scratch / "none.obj").string(), std::string("stoone")}) {
    session.takeMessages();
    openNow(session, file);
    const auto messages = session.takeMessages();
    ASSERT_EQ(messages.size(), 1u) << file;
    EXPECT_TRUE(messages.front().problem);
    EXPECT_EQ(fingerprint(session.state()), before) << file;
  }
}

TEST(Session, ANewModelTakesTheOldOnesPlace) {
  const ScratchFolder scratch;
  std::ofstream(scratch / "tetra.off") << kTriangle;
  Session session;
  openNow(session, "stone");
  session.state().scene.objects[0].size = 12;
  session.state().scene.objects[0].material.roughness = 0.7;
  session.state().scene.lights.resize(1);
  openNow(session, (scratch / "tetra.off").string());
  const Scene& scene = session.state().scene;
  EXPECT_EQ(scene.objects[0].mesh->triangles.size(), 4u);
  EXPECT_EQ(scene.objects[0].size, 12);
  EXPECT_EQ(scene.objects[0].material.roughness, 0.7);
  EXPECT_EQ(scene.lights.size(), 1u);
  session.undo();
  EXPECT_EQ(session.state().scene.objects[0].model, "stone");
  session.redo();
  EXPECT_EQ(session.state().scene.objects[0].mesh->triangles.size(), 4u);
}

TEST(Session, UndoTakesInWhatWasNotCommitted) {
  Session session;
  openNow(session, "sphere");
  session.state().toneMapping.exposure = 3;
  session.undo();
  EXPECT_EQ(session.state().toneMapping.exposure, 0);
  session.redo();
  EXPECT_EQ(session.state().toneMapping.exposure, 3);
}

TEST(Session, ASavedSceneReadsBackEqual) {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "models");
  std::ofstream(scratch / "models/tetra.off") << kTriangle;
  Session session;
  openNow(session, (scratch / "models/tetra.off").string());
  session.state().scene.objects[0].size = 1.0 / 3;
  ASSERT_EQ(session.saveSceneAs(scratch / "saved.toml"), scratch / "saved.toml");
  EXPECT_NE(textOf(scratch / "saved.toml").find("\"models/tetra.off\""), std::string::npos);
  Session again;
  openNow(again, (scratch / "saved.toml").string());
  EXPECT_EQ(sceneToToml(again.state().scene), sceneToToml(session.state().scene));
  EXPECT_EQ(again.saveScene(), fs::absolute(scratch / "saved.toml"));
}

TEST(Session, WhatCannotBeSavedIsAMessage) {
  Session session;
  openNow(session, "sphere");
  session.takeMessages();
  EXPECT_TRUE(session.saveSceneAs("/nonexistent/folder/scene.toml").empty());
  EXPECT_NE(allText(session).find("no folder"), std::string::npos);
}

TEST(Session, LoadsAFileAgainWhenItChanges) {
  const ScratchFolder scratch;
  const fs::path file = scratch / "tetra.off";
  std::ofstream(file) << kTriangle;
  Session session;
  openNow(session, file.string());
  session.state().scene.objects[0].size = 7;
  std::string doubled = kTriangle;
  doubled.replace(doubled.find("1 0 0"), 5, "2 0 0");
  const auto settle = [&](double seconds) {
    session.poll(seconds);
    session.finishLoading();
  };
  std::ofstream(file) << doubled;
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(5));
  settle(1);
  settle(2);
  EXPECT_EQ(boundsOf(*session.state().scene.objects[0].mesh).max.x, 2);
  EXPECT_EQ(session.state().scene.objects[0].size, 7);
  EXPECT_NE(allText(session).find("loaded again"), std::string::npos);
  std::ofstream(file) << "half wri";
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(50));
  settle(3);
  settle(4);
  EXPECT_EQ(boundsOf(*session.state().scene.objects[0].mesh).max.x, 2);
}

TEST(Session, APictureIsOpenedToCompareWith) {
  const ScratchFolder scratch;
  Image image(3, 2);
  image.setRgb(0, {1, 2, 3});
  writeExr(image, scratch / "truth.exr");
  Session session;
  openNow(session, "sphere");
  openNow(session, (scratch / "truth.exr").string());
  ASSERT_TRUE(session.picture());
  EXPECT_EQ(session.picture()->width(), 3);
  EXPECT_EQ(session.pictureName(), "truth.exr");
  EXPECT_EQ(session.documentName(), "sphere");
  EXPECT_EQ(session.state().compare.right, CompareView::Source::kFile);
}

TEST(Session, PicturesAreWrittenBehindUnderNamesOfTheirOwn) {
  const ScratchFolder scratch;
  Session session;
  openNow(session, "sphere");
  session.saveSceneAs(scratch / "scene.toml");
  session.state().settings.method = Method::kMatched;  // whose files do not say how long it took
  session.state().settings.mapSize = 128;
  session.savePicture(24, 16);
  session.savePicture(24, 16);
  session.savePicture(24, 16, scratch / "nowhere/x.png");
  finishPictures(session);
  EXPECT_EQ(readImage(scratch / "sphere.png").width(), 24);
  EXPECT_EQ(textOf(scratch / "sphere.png"), textOf(scratch / "sphere-2.png"));
  EXPECT_NE(allText(session).find("was not written"), std::string::npos);
}

}  // namespace
}  // namespace lychnite
