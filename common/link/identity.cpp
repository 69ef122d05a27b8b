#include "common/link/identity.hpp"

#include <fmt/ranges.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "common/error/printable.hpp"

namespace toryu {

namespace {

template <auto release>
struct Deleter {
  template <class Handle>
  void operator()(Handle* handle) const {
    release(handle);
  }
};
using File = std::unique_ptr<BIO, Deleter<BIO_free_all>>;
using Certificate = std::unique_ptr<X509, Deleter<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Deleter<EVP_PKEY_free>>;
using Document = std::unique_ptr<PKCS7, Deleter<PKCS7_free>>;
using Time = std::unique_ptr<ASN1_TIME, Deleter<ASN1_TIME_free>>;
using Store = std::unique_ptr<X509_STORE, Deleter<X509_STORE_free>>;

/// The text of the first element of that name.
std::string element(const std::string& xml, const std::string& name) {
  const auto begin = xml.find('<' + name + '>'), end = xml.find("</" + name + '>');
  if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
  return xml.substr(begin + name.size() + 2, end - begin - name.size() - 2);
}

/// Of "2027-01-31T12:00:00Z" (xs:dateTime); nothing if it is none.
Time time_of(std::string text) {
  std::erase_if(text, [](char c) { return c == '-' || c == ':' || c == 'T'; });
  Time time(ASN1_TIME_new());
  return ASN1_TIME_set_string_X509(time.get(), text.c_str()) == 1 ? std::move(time) : Time();
}

std::string time_text(const std::tm& parts) {
  char text[32];
  std::strftime(text, sizeof text, "%F %T UTC", &parts);
  return text;
}

std::string time_text(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? time_text(parts) : "an unknown time";
}

std::string common_name(const X509_NAME* name) {
  char text[256];
  const int length = X509_NAME_get_text_by_NID(name, NID_commonName, text, sizeof text);
  return length < 0 ? "nobody" : printable(text);
}

Certificate certificate_in(BIO* file) {
  return Certificate(PEM_read_bio_X509(file, nullptr, nullptr, nullptr));
}

/// The files of one part, read one by one; what is wrong with each is collected.
class Files {
 public:
  Files(std::filesystem::path folder, std::string part)
      : folder_(std::move(folder)), part_(std::move(part)) {}

  std::vector<InputError> faults() {
    std::error_code error;
    if (!std::filesystem::is_directory(folder_, error)) {
      add("", "is no folder; './run.sh --make-identities FOLDER' makes one");
      return faults_;
    }
    check_mode("", 022, "can be changed by others", "go-w", "keeps it yours");
    const Certificate authority = certificate("ca.pem"), own = certificate(part_ + ".pem");
    const Key own_key = key();
    if (authority) check_dates("ca.pem", *authority);
    if (own) check(*own, authority.get(), own_key.get());
    if (!authority) return faults_;
    signed_text("governance.p7s", *authority);
    if (const auto permissions = signed_text(part_ + ".p7s", *authority)) check_permissions(*permissions);
    return faults_;
  }
  /// Of those that were read.
  const Expiry& expiry() const { return expiry_; }

 private:
  void add(const std::string& name, const std::string& message) {
    faults_.push_back(
        {.place = "--secure " + (name.empty() ? folder_ : folder_ / name).string(), .message = message});
  }

  File open(const std::string& name) {
    File file(BIO_new_file((folder_ / name).c_str(), "r"));
    if (!file) add(name, fmt::format("cannot be read: {}", std::strerror(errno)));
    if (file && !name.ends_with(".key"))
      check_mode(name, 022, "can be changed by others", "go-w", "keeps it yours");
    return file;
  }

  /// A folder that others may change can hold another CA tomorrow, and identities that it has signed.
  void check_mode(const std::string& name, mode_t forbidden, const char* what, const char* mode,
                  const char* use) {
    struct stat status {};
    if (stat((folder_ / name).c_str(), &status) == 0 && (status.st_mode & forbidden) != 0)
      add(name, fmt::format("{} (mode {:04o}); 'chmod {}' {}", what, status.st_mode & 07777, mode, use));
  }

  Certificate certificate(const std::string& name) {
    const File file = open(name);
    if (!file) return {};
    Certificate found = certificate_in(file.get());
    if (!found) add(name, "holds no certificate (PEM)");
    return found;
  }

  Key key() {
    const std::string name = part_ + ".key";
    const File file = open(name);
    if (!file) return {};
    check_mode(name, 077, "is a private key that others can read", "600", "keeps it secret");
    const auto no_password = [](char*, int, int, void*) { return -1; };
    Key found(PEM_read_bio_PrivateKey(file.get(), nullptr, no_password, nullptr));
    if (!found) add(name, "holds no private key without a password (PEM)");
    return found;
  }

  void check_dates(const std::string& name, const X509& given) {
    check_dates(name, X509_get0_notBefore(&given), X509_get0_notAfter(&given));
  }

  void check_dates(const std::string& name, const ASN1_TIME* begin, const ASN1_TIME* end) {
    if (X509_cmp_current_time(begin) > 0)
      add(name,
          fmt::format("is valid from {} on only; is the clock of this machine right?", time_text(begin)));
    if (X509_cmp_current_time(end) < 0)
      add(name, fmt::format("expired on {}; './run.sh --make-identities' makes new ones", time_text(end)));
    std::tm parts{};
    if (ASN1_TIME_to_tm(end, &parts) != 1) return;
    const std::time_t time = timegm(&parts);
    if (time < expiry_.time) expiry_ = {(folder_ / name).string(), time};
  }

  void check(X509& own, X509* authority, EVP_PKEY* own_key) {
    const std::string name = part_ + ".pem", subject = common_name(X509_get_subject_name(&own));
    check_dates(name, own);
    if (subject != part_)
      add(name, fmt::format("is the certificate of the part '{}', and must be that of '{}'", subject, part_));
    if (authority != nullptr && X509_verify(&own, X509_get0_pubkey(authority)) != 1)
      add(name, fmt::format("is of another CA: '{}' has signed it, ca.pem is '{}'",
                            common_name(X509_get_issuer_name(&own)),
                            common_name(X509_get_subject_name(authority))));
    if (own_key != nullptr && X509_check_private_key(&own, own_key) != 1)
      add(part_ + ".key", fmt::format("is not the key of {}", name));
  }

  /// What was signed; nothing if it was not, which is told.
  std::optional<std::string> signed_text(const std::string& name, X509& authority) {
    const File file = open(name);
    if (!file) return std::nullopt;
    BIO* detached = nullptr;
    const Document document(SMIME_read_PKCS7(file.get(), &detached));
    const File content(detached), text(BIO_new(BIO_s_mem()));
    if (!document) {
      add(name, "is no document signed as S/MIME");
      return std::nullopt;
    }
    const Store store(X509_STORE_new());
    X509_STORE_add_cert(store.get(), &authority);
    if (PKCS7_verify(document.get(), nullptr, store.get(), content.get(), text.get(), 0) != 1) {
      add(name, "is not signed by the CA of ca.pem, or was changed since");
      return std::nullopt;
    }
    char* data = nullptr;
    const long size = BIO_get_mem_data(text.get(), &data);
    return std::string(data, static_cast<std::size_t>(size));
  }

  /// Of whom they are, and when: to Cyclone DDS both are a fault of setting up.
  void check_permissions(const std::string& xml) {
    const std::string name = part_ + ".p7s", subject = element(xml, "subject_name");
    if (subject != "CN=" + part_)
      add(name, fmt::format("holds the permissions of '{}', and must hold those of 'CN={}'",
                            printable(subject), part_));
    const Time begin = time_of(element(xml, "not_before")), end = time_of(element(xml, "not_after"));
    if (begin && end)
      check_dates(name, begin.get(), end.get());
    else
      add(name, "does not say from when to when it is valid");
  }

  std::filesystem::path folder_;
  std::string part_;
  std::vector<InputError> faults_;
  Expiry expiry_;
};

}  // namespace

Expiry check_identity(const Network& network, const std::string& part) {
  if (network.secure.empty()) return {};
  Files files(network.secure, part);
  const auto faults = files.faults();
  if (!faults.empty()) throw BadInput(faults);
  return files.expiry();
}

void check_expiry(const Expiry& expiry) {
  constexpr std::time_t last_words = 2;  // [s] in which the others are told
  if (std::time(nullptr) < expiry.time - last_words) return;
  std::tm parts{};
  gmtime_r(&expiry.time, &parts);
  throw BadInput(
      {{.place = "--secure " + expiry.file,
        .message = fmt::format("expires on {}, in mid-run: no message passes from then on; './run.sh "
                               "--make-identities' makes new ones, and --restart goes on from the newest "
                               "checkpoint",
                               time_text(parts))}});
}

void check_secured(const Options& options, bool coupled, const std::string& part) {
  if (options.network.secure.empty()) return;
  if (!coupled)
    throw BadInput({{.place = "--secure " + options.network.secure,
                     .message = "the case is not coupled: one program computes it, and sends nothing"}});
  if (options.check) check_identity(options.network, part);
}

Credential credential_of(const Network& network, const std::string& part) {
  const std::filesystem::path folder = network.secure;
  const File own_file(BIO_new_file((folder / (part + ".pem")).c_str(), "r")),
      file(BIO_new_file((folder / "ca.pem").c_str(), "r"));
  if (network.secure.empty() || !own_file || !file) return {};
  const Certificate own = certificate_in(own_file.get()), authority = certificate_in(file.get());
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (!own || !authority || X509_digest(authority.get(), EVP_sha256(), digest, &size) != 1) return {};
  return {common_name(X509_get_subject_name(own.get())),
          fmt::format("{:02x}", fmt::join(digest, digest + size, ""))};
}

}  // namespace toryu
