/// Identities: what is wrong with their files, and what each part may write and read.
#include <gmock/gmock.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "common/link/identity.hpp"
#include "link_sides.hpp"

namespace toryu {
namespace {

using testing::ElementsAre;
namespace fs = std::filesystem;

class Identities : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new fs::path(fs::temp_directory_path() / fmt::format("toryu_identities_{}", getpid()));
    for (const char* name : {"of_run", "of_other"})
      ASSERT_EQ(
          std::system(fmt::format("/usr/bin/python3 -I -X utf8 {}/tools/toryu identities --make-identities "
                                  "{} > /dev/null",
                                  SOURCE_FOLDER, (*folder_ / name).string())
                          .c_str()),
          0);
  }
  static void TearDownTestSuite() {
    fs::remove_all(*folder_);
    delete folder_;
  }
  void SetUp() override { fs::copy(*folder_ / "of_run", mine_); }
  void TearDown() override { fs::remove_all(mine_); }

  void replace(const std::string& name, const std::string& by_name, const char* of = "of_run") {
    fs::copy_file(*folder_ / of / by_name, mine_ / name, fs::copy_options::overwrite_existing);
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(mine_ / name) << text; }
  /// What is wrong, each with the name of its file.
  std::vector<std::string> faults_of(const std::string& part) {
    std::vector<std::string> found;
    try {
      check_identity({.secure = mine_.string()}, part);
    } catch (const BadInput& error) {
      for (const InputError& each : error.errors())
        found.push_back(fs::path(each.place).filename().string() + ": " + each.message);
    }
    return found;
  }
  /// Changes when fluid.pem is valid, which breaks its seal.
  void date(long begin, long end) {
    std::FILE* file = std::fopen((mine_ / "fluid.pem").c_str(), "r");
    X509* certificate = PEM_read_X509(file, nullptr, nullptr, nullptr);
    std::fclose(file);
    ASN1_TIME* time = X509_gmtime_adj(nullptr, begin);
    X509_set1_notBefore(certificate, time);
    X509_set1_notAfter(certificate, X509_gmtime_adj(time, end));
    ASN1_TIME_free(time);
    i2d_re_X509_tbs(certificate, nullptr);  // what is written is kept from when it was read
    file = std::fopen((mine_ / "fluid.pem").c_str(), "w");
    PEM_write_X509(file, certificate);
    std::fclose(file);
    X509_free(certificate);
  }

  static fs::path* folder_;
  fs::path mine_ = *folder_ / "mine";
};
fs::path* Identities::folder_ = nullptr;

TEST_F(Identities, OfAllPartsAreValidAsMade) {
  for (const char* part : {"coupler", "fluid", "solid"}) EXPECT_THAT(faults_of(part), ElementsAre());
  EXPECT_NO_THROW(check_identity({}, "fluid"));
}

TEST_F(Identities, HaveKeysThatTheirOwnerAloneReads) {
  for (const char* part : {"coupler", "fluid", "solid"})
    EXPECT_EQ(fs::status(mine_ / fmt::format("{}.key", part)).permissions(), fs::perms(0600)) << part;
  EXPECT_FALSE(fs::exists(mine_ / "ca.key")) << "who has it can make others";
  fs::permissions(mine_ / "fluid.key", fs::perms(0640));
  EXPECT_THAT(faults_of("fluid"), ElementsAre("fluid.key: is a private key that others can read (mode 0640); "
                                              "'chmod 600' keeps it secret"));
}

TEST_F(Identities, AreInAFolderThatTheirOwnerAloneChanges) {
  fs::permissions(mine_, fs::perms(0777));
  EXPECT_THAT(faults_of("fluid"),
              ElementsAre("mine: can be changed by others (mode 0777); 'chmod go-w' keeps it yours"));
  fs::permissions(mine_, fs::perms(0755));
  EXPECT_THAT(faults_of("fluid"), ElementsAre());
  fs::permissions(mine_ / "ca.pem", fs::perms(0666));
  EXPECT_THAT(faults_of("fluid"),
              ElementsAre("ca.pem: can be changed by others (mode 0666); 'chmod go-w' keeps it yours"));
}

TEST_F(Identities, MayBeThoseOfTheOwnPartAlone) {
  for (const char* name : {"coupler.pem", "coupler.key", "coupler.p7s"}) fs::remove(mine_ / name);
  EXPECT_THAT(faults_of("fluid"), ElementsAre());
  EXPECT_THAT(faults_of("coupler"), ElementsAre("coupler.pem: cannot be read: No such file or directory",
                                                "coupler.key: cannot be read: No such file or directory",
                                                "coupler.p7s: cannot be read: No such file or directory"));
  fs::remove_all(mine_);
  EXPECT_THAT(faults_of("fluid"),
              ElementsAre("mine: is no folder; './run.sh --make-identities FOLDER' makes one"));
}

TEST_F(Identities, OfAnotherPartOrAuthorityAreRefused) {
  replace("fluid.pem", "solid.pem");
  EXPECT_THAT(faults_of("fluid"),
              ElementsAre("fluid.pem: is the certificate of the part 'solid', and must be that of 'fluid'",
                          "fluid.key: is not the key of fluid.pem"));
  replace("fluid.pem", "fluid.pem", "of_other");
  replace("fluid.key", "fluid.key", "of_other");
  replace("fluid.p7s", "fluid.p7s", "of_other");
  EXPECT_THAT(faults_of("fluid"),
              ElementsAre(HasSubstr("fluid.pem: is of another CA: 'toryu "),
                          "fluid.p7s: is not signed by the CA of ca.pem, or was changed since"));
}

TEST_F(Identities, ThatAreNoSuchFilesAreRefused) {
  for (const char* name : {"fluid.pem", "fluid.key", "fluid.p7s"}) write(name, "no such thing\n");
  EXPECT_THAT(faults_of("fluid"), ElementsAre("fluid.pem: holds no certificate (PEM)",
                                              "fluid.key: holds no private key without a password (PEM)",
                                              "fluid.p7s: is no document signed as S/MIME"));
}

TEST_F(Identities, ThatWereChangedAreRefused) {
  std::ifstream file(mine_ / "governance.p7s");
  std::string text(std::istreambuf_iterator<char>(file), {});
  text.replace(text.find("<enable_join_access_control>true"), 32, "<enable_join_access_control>fals");
  write("governance.p7s", text);
  EXPECT_THAT(faults_of("fluid"),
              ElementsAre("governance.p7s: is not signed by the CA of ca.pem, or was changed since"));
}

TEST_F(Identities, HavePermissionsOfTheirPartAndTime) {
  replace("fluid.p7s", "solid.p7s");
  EXPECT_THAT(faults_of("fluid"),
              ElementsAre("fluid.p7s: holds the permissions of 'CN=solid', and must hold those of "
                          "'CN=fluid'"));
  const fs::path late = mine_ / "late";
  ASSERT_EQ(std::system(fmt::format("PYTHONPATH={}/tools /usr/bin/python3 -c 'import pathlib\n"
                                    "from toryu import identities\n"
                                    "made = identities.permissions\n"
                                    "identities.permissions = lambda part, now, days: made(part, now, -0.5)\n"
                                    "identities.make(pathlib.Path(\"{}\"))'",
                                    SOURCE_FOLDER, late.string())
                            .c_str()),
            0);
  for (const auto& file : fs::directory_iterator(late))
    fs::copy(file, mine_, fs::copy_options::overwrite_existing);
  EXPECT_THAT(faults_of("fluid"), ElementsAre(HasSubstr("fluid.p7s: expired on 20")));
}

TEST_F(Identities, AreValidForATimeAlone) {
  date(-7200, -3600);
  EXPECT_THAT(faults_of("fluid"),
              testing::Contains(testing::AllOf(HasSubstr("fluid.pem: expired on 20"),
                                               HasSubstr(" UTC; './run.sh --make-ident"))));
  date(3600, 7200);
  EXPECT_THAT(faults_of("fluid"), testing::Contains(HasSubstr("fluid.pem: is valid from 20")));
}

TEST_F(Identities, EndWithTheFirstOfTheirFiles) {
  Network network;
  network.secure = mine_.string();
  const Expiry expiry = check_identity(network, "fluid");
  const std::time_t now = std::time(nullptr), year = 365 * 86400;
  EXPECT_THAT(expiry.time, testing::AllOf(testing::Gt(now + year - 3600), testing::Lt(now + year + 60)));
  EXPECT_NO_THROW(check_expiry(expiry));
  EXPECT_NO_THROW(check_expiry(check_identity({}, "fluid")));
  EXPECT_THROW(check_expiry({expiry.file, now - 1}), BadInput);
}

/// Each topic has one part that writes it; all else is refused, to those who have an identity too.
TEST_F(Identities, LetEachPartWriteAndReadItsTopicsAlone) {
  struct Right {
    const char *topic, *writer, *reader, *reader_too = "";
  };
  const Right rights[] = {{wire::hello_from_fluid, "fluid", "coupler"},
                          {wire::hello_from_solid, "solid", "coupler"},
                          {wire::session, "coupler", "fluid", "solid"},
                          {wire::status_from_fluid, "fluid", "coupler"},
                          {wire::status_from_solid, "solid", "coupler"},
                          {wire::interface_from_solid, "solid", "coupler"},
                          {wire::interface_to_fluid, "coupler", "fluid"},
                          {wire::motion_from_solid, "solid", "coupler"},
                          {wire::motion_to_fluid, "coupler", "fluid"},
                          {wire::load_from_fluid, "fluid", "coupler"},
                          {wire::load_to_solid, "coupler", "solid"},
                          {wire::checkpoint_request, "coupler", "fluid", "solid"},
                          {wire::checkpoint_from_fluid, "fluid", "coupler"},
                          {wire::checkpoint_from_solid, "solid", "coupler"},
                          {"toryu/any", "nobody", "nobody"}};
  for (const char* part : {"coupler", "fluid", "solid"}) {
    const auto out = mine_ / fmt::format("out_{}", part);
    dds::Node node(dds::rendezvous(out, {.secure = mine_.string()}), {"program", part});
    for (const Right& right : rights) {
      const auto words = fmt::format("{} and {}", part, right.topic);
      const auto refused = ThrowsMessage<std::runtime_error>(HasSubstr("Not Allowed By Security"));
      const auto writes = [&] { node.make_writer(toryu_Status_desc, right.topic); };
      const auto reads = [&] { node.make_reader(toryu_Status_desc, right.topic); };
      if (part == std::string(right.writer))
        EXPECT_NO_THROW(writes()) << words;
      else
        EXPECT_THAT(writes, refused) << words;
      if (part == std::string(right.reader) || part == std::string(right.reader_too))
        EXPECT_NO_THROW(reads()) << words;
      else
        EXPECT_THAT(reads, refused) << words;
    }
  }
}

}  // namespace
}  // namespace toryu
