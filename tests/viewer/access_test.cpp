#include "viewer/access.hpp"

#include <gtest/gtest.h>

#include "viewer/files.hpp"

namespace cleancolor {
namespace {

Access access_at(const std::string& address) {
  return {.token = "0123456789abcdef", .address = address, .port = 8737};
}

bool knows(const std::string& cookie, const std::string& authorization) {
  return access_at("127.0.0.1")
      .knows_token({.host = "", .origin = "", .cookie = cookie, .authorization = authorization});
}

TEST(Access, MakesTokensThatDiffer) {
  const std::string token = random_token();
  EXPECT_EQ(token.size(), 32u);
  EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), token.npos);
  EXPECT_NE(token, random_token());
}

TEST(Access, ComparesSecretsAsAWhole) {
  EXPECT_TRUE(same_secret("abc", "abc"));
  EXPECT_TRUE(same_secret("", ""));
  for (const char* other : {"", "a", "abd", "bbc", "abcd", "abcabc"}) {
    EXPECT_FALSE(same_secret("abc", other)) << other;
    EXPECT_FALSE(same_secret(other, "abc")) << other;
  }
}

TEST(Access, FindsTheTokenInCookieOrHeader) {
  EXPECT_TRUE(knows("cleancolor_8737=0123456789abcdef", ""));
  EXPECT_TRUE(knows("a=b; cleancolor_8737=0123456789abcdef;c", ""));
  EXPECT_TRUE(knows("", "Bearer 0123456789abcdef"));
  EXPECT_TRUE(knows("", "bearer  0123456789abcdef "));
}

TEST(Access, RefusesEverythingElse) {
  for (const char* cookie : {"", "=", ";;;", "cleancolor_8737", "cleancolor_8737=", "cleancolor_8738=0123456789abcdef",
                             "xcleancolor_8737=0123456789abcdef", "cleancolor_8737=0123456789abcdeF"})
    EXPECT_FALSE(knows(cookie, "")) << cookie;
  for (const char* header : {"", "Bearer", "Bearer ", "0123456789abcdef", "Basic 0123456789abcdef", "Bearer 0123"})
    EXPECT_FALSE(knows("", header)) << header;
}

TEST(Access, WithoutATokenNobodyGetsIn) {
  const Access access{.token = "", .address = "127.0.0.1", .port = 8737};
  EXPECT_FALSE(access.knows_token({.host = "", .origin = "", .cookie = "", .authorization = ""}));
}

TEST(Access, ServesItsOwnNamesOnly) {
  const Access local = access_at("127.0.0.1");
  for (const char* host : {"127.0.0.1:8737", "localhost:8737", "LocalHost:8737"})
    EXPECT_TRUE(local.is_host(host)) << host;
  for (const char* host : {"", ":8737", "127.0.0.1", "127.0.0.1:80", "evil.example:8737", "127.0.0.1.evil.example:8737",
                           "192.168.0.1:8737", "localhost:87370"})
    EXPECT_FALSE(local.is_host(host)) << host;
  EXPECT_TRUE(access_at("::1").is_host("[::1]:8737"));
  EXPECT_TRUE(access_at("0:0::1").is_host("[::1]:8737"));
  EXPECT_TRUE(access_at("FE80::00A").is_host("[fe80::a]:8737"));
  EXPECT_TRUE(access_at("My.House").is_host("my.house:8737"));
  EXPECT_FALSE(access_at("::1").is_host("::1:8737"));
  EXPECT_FALSE(access_at("127.0.0.1").is_host("[127.0.0.1]:8737"));
  const Access all = access_at("0.0.0.0");
  EXPECT_TRUE(all.is_host("192.168.0.1:8737"));
  EXPECT_TRUE(all.is_host("[fe80::1]:8737"));
  EXPECT_FALSE(all.is_host("evil.example:8737"));
}

TEST(Access, OtherSitesAndOtherPortsMayNotAsk) {
  const auto is_origin = [](const std::string& origin) {
    return access_at("127.0.0.1")
        .is_origin({.host = "127.0.0.1:8737", .origin = origin, .cookie = "", .authorization = ""});
  };
  EXPECT_TRUE(is_origin(""));
  EXPECT_TRUE(is_origin("http://127.0.0.1:8737"));
  for (const char* origin : {"null", "http://127.0.0.1:3000", "https://127.0.0.1:8737", "http://evil.example"})
    EXPECT_FALSE(is_origin(origin)) << origin;
}

TEST(Access, NamesTheAddressToOpen) {
  EXPECT_EQ(access_at("127.0.0.1").url(), "http://127.0.0.1:8737");
  EXPECT_EQ(access_at("::1").url(), "http://[::1]:8737");
  EXPECT_EQ(access_at("0.0.0.0").url(), "http://127.0.0.1:8737");
}

TEST(FileNames, LeadNowhereElse) {
  EXPECT_EQ(file_name("ocean.stl"), "ocean.stl");
  EXPECT_EQ(file_name("../../etc/passwd"), "passwd");
  EXPECT_EQ(file_name("C:\\parts\\robot ice.3mf"), "robot ice.3mf");
  for (const char* nothing : {"", "..", "/", "...", "a/..", " "}) EXPECT_EQ(file_name(nothing), "upload") << nothing;
  EXPECT_EQ(file_name(".hidden.stl"), "hidden.stl");
  EXPECT_EQ(file_name(std::string_view("a\0b\n.stl", 8)), "a?b?.stl");
  const std::string name = file_name(std::string(1000, 'x') + ".stl");
  EXPECT_LE(name.size(), 100u);
  EXPECT_TRUE(name.ends_with("x.stl"));
}

TEST(Files, GoWithTheirLastHolderAndTheFolderWithTheProgram) {
  std::filesystem::path folder;
  {
    TempFolder temp;
    folder = temp.path();
    EXPECT_EQ(std::filesystem::status(folder).permissions(), std::filesystem::perms::owner_all);
    FileHandle file = temp.new_file("a.stl");
    EXPECT_NE(file->path(), temp.new_file("a.stl")->path());
    const std::filesystem::path path = file->path();
    EXPECT_TRUE(std::filesystem::exists(path.parent_path()));
    file.reset();
    EXPECT_FALSE(std::filesystem::exists(path.parent_path()));
  }
  EXPECT_FALSE(std::filesystem::exists(folder));
}

}  // namespace
}  // namespace cleancolor
