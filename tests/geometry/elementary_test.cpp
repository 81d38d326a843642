// Elementary functions: against those of a long double, whose digits are more, and against values
// that were computed to a hundred digits (by mpmath).
#include "geometry/elementary.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "base/hash.hpp"
#include "base/random.hpp"

namespace lantern::geometry {
namespace {

// In units of the last place of the nearest double.
double error(double found, long double wanted) {
  const double size = std::abs(static_cast<double>(wanted));
  const double ulp = std::nextafter(size, INFINITY) - size;
  return std::abs(static_cast<double>(found - wanted)) / ulp;
}

double any_double(Random& random) {
  for (;;)
    if (const auto x = std::bit_cast<double>(random.bits()); std::isnormal(x)) return x;
}

constexpr double kRounded = 0.501, kNearly = 0.8;

TEST(Elementary, IsWithinAUnitOfTheLastPlace) {
  struct Function {
    const char* name;
    double (*found)(double);
    long double (*wanted)(long double);
    double low, high, most = kRounded;
  };
  Random random(1);
  for (const Function& f : {Function{"sin", sin, std::sin, -0.8, 0.8, kNearly},
                            {"sin", sin, std::sin, -10, 10, kNearly},
                            {"sin", sin, std::sin, -2e5, 2e5, kNearly},
                            {"cos", cos, std::cos, -0.8, 0.8, kNearly},
                            {"cos", cos, std::cos, -10, 10, kNearly},
                            {"cos", cos, std::cos, -2e5, 2e5, kNearly},
                            {"tan", tan, std::tan, -10, 10},
                            {"asin", asin, std::asin, -1, 1},
                            {"atan", atan, std::atan, -20, 20},
                            {"log", log, std::log, 0, 20},
                            {"log", log, std::log, 0.999, 1.001},
                            {"log2", log2, std::log2, 0, 20},
                            {"log10", log10, std::log10, 0, 2000}})
    for (int i = 0; i < 5000; ++i) {
      const double x = random.between(f.low, f.high);
      ASSERT_LE(error(f.found(x), f.wanted(x)), f.most) << f.name << " of " << x;
    }
}

TEST(Elementary, IsRightForNumbersOfAnySize) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const double x = any_double(random), y = any_double(random);
    ASSERT_LE(error(sin(x), std::sin(static_cast<long double>(x))), kNearly) << x;
    ASSERT_LE(error(cos(x), std::cos(static_cast<long double>(x))), kNearly) << x;
    ASSERT_LE(error(atan(x), std::atan(static_cast<long double>(x))), kRounded) << x;
    ASSERT_LE(error(atan2(y, x), std::atan2(static_cast<long double>(y), x)), kRounded) << y;
    ASSERT_LE(error(log(std::abs(x)), std::log(std::abs(static_cast<long double>(x)))), kRounded);
    const long double a =
        std::ldexp(random.between(-1, 1), static_cast<int>(random.whole(-30, 30)));
    const long double b = random.between(-1, 1), c = random.between(-1, 1);
    const int scale = static_cast<int>(random.whole(-900, 900));
    const auto scaled_up = [&](long double v) { return std::ldexp(static_cast<double>(v), scale); };
    ASSERT_LE(error(hypot(scaled_up(a), scaled_up(b), scaled_up(c)),
                    std::ldexp(std::sqrt(a * a + b * b + c * c), scale)),
              kRounded);
    const double base = std::exp(random.between(-5, 5)), power = random.between(-100, 100);
    ASSERT_LE(error(pow(base, power), std::pow(static_cast<long double>(base), power)), kRounded)
        << base << " to the " << power;
  }
}

TEST(Elementary, IsExactWhereThatCanBe) {
  for (int n = -22; n <= 22; ++n) {
    const double power = std::stod("1e" + std::to_string(n));
    EXPECT_EQ(pow(10, n), power);
    EXPECT_EQ(log10(power), n);
    EXPECT_EQ(log2(std::ldexp(1.0, n)), n);
    EXPECT_EQ(pow(2, n), std::ldexp(1.0, n));
    EXPECT_EQ(pow(-3, n), (n % 2 == 0 ? 1 : -1) * pow(3, n));
  }
  EXPECT_EQ(hypot(3, 4), 5);
  EXPECT_EQ(hypot(0x2p-999, 0x3p-999, 0x6p-999), 0x7p-999);
  EXPECT_EQ(hypot(0, -0.0), 0);
  EXPECT_EQ(sin(0.0), 0);
  EXPECT_EQ(sin(std::numeric_limits<double>::denorm_min()), 0x1p-1074);
  EXPECT_EQ(pow(10, -320), 1e-320);
}

TEST(Elementary, EndsAsThoseOfTheLanguageDo) {
  constexpr double kInf = INFINITY;
  for (const double x : {0.0, -0.0, 1.0, -1.0, 2.5, -3.0, kInf, -kInf, std::nan("")})
    for (const double y : {0.0, -0.0, 1.0, -1.0, 2.5, -3.0, kInf, -kInf, std::nan("")}) {
      EXPECT_EQ(std::isnan(pow(x, y)), std::isnan(std::pow(x, y))) << x << " " << y;
      if (!std::isnan(pow(x, y))) {
        EXPECT_DOUBLE_EQ(pow(x, y), std::pow(x, y)) << x << " " << y;
      }
      if (std::isnan(x) || std::isnan(y)) continue;
      EXPECT_DOUBLE_EQ(atan2(y, x), std::atan2(y, x)) << y << " " << x;
      EXPECT_EQ(std::signbit(atan2(y, x)), std::signbit(std::atan2(y, x))) << y << " " << x;
      EXPECT_DOUBLE_EQ(hypot(x, y), std::hypot(x, y)) << y << " " << x;
    }
  EXPECT_EQ(atan2(-1e-300, -1e300), -std::atan2(0.0, -1.0)) << "on its own side";
  EXPECT_EQ(pow(10, 400), kInf);
  EXPECT_EQ(pow(10, -400), 0);
  EXPECT_EQ(log(0.0), -kInf);
  for (const double x : {std::sin(kInf), sin(kInf), cos(-kInf), tan(kInf), log(-1.0), asin(1.5)})
    EXPECT_TRUE(std::isnan(x));
}

// Among them the double that is nearest to a multiple of pi/2, 6381956970095103 * 2^797.
TEST(Elementary, HasTwiceTheDigitsInATwofold) {
  const auto atan = [](const Twofold& x) { return atan2(x, 1); };
  const auto sine = [](const Twofold& x) { return sin_cos(x).sin; };
  const auto cosine = [](const Twofold& x) { return sin_cos(x).cos; };
  const auto expect = [](const char* name, const Twofold& found, const Twofold& wanted) {
    EXPECT_LE(std::abs(double((found - wanted) / wanted)), 1e-29) << name << " " << wanted.high;
  };
  struct Known {
    double x;
    Twofold value;
  };
  for (const auto& [x, value] :
       {Known{0x1p-1, {0x1.eaee8744b05f0p-2, -0x1.789b43c9b027dp-58}},
        {0x1.8p+1, {0x1.210386db6d55bp-3, 0x1.3c7205d08d063p-57}},
        {0x1.6p+4, {-0x1.220a29f6eb9f4p-7, 0x1.504b8bc40d505p-62}},
        {0x1.86a0p+16, {0x1.24daa9c527e96p-5, 0x1.c767d8e3e1ca8p-60}},
        {-0x1.0f0cf064dd592p+73, {0x1.b453ab76bf397p-1, 0x1.f453790772648p-58}}})
    expect("sin", sine(x), value);
  for (const auto& [x, value] :
       {Known{0x1p-1, {0x1.c1528065b7d50p-1, -0x1.892111312e828p-55}},
        {0x1.6p+3, {0x1.220ae41ee2fdfp-8, 0x1.7f17841b97bf3p-62}},
        {0x1.6ac5b262ca1ffp+849, {-0x1.14ae72e6ba22fp-61, 0x1.73eef1477d90ep-118}},
        {0x1.7e43c8800759cp+996, {-0x1.2699022adc4c1p-1, 0x1.edd5594b5c574p-56}}}) {
    expect("cos", cosine(x), value);
    EXPECT_LE(error(cos(x), static_cast<long double>(value.high) + value.low), kNearly);
  }
  for (const auto& [x, value] :
       {Known{-20, {0x1.1b48655f37267p-29, -0x1.9fb4baeafe811p-85}},
        {0x1.0624dd2f1a9fcp-10, {0x1.0041919b7ee34p+0, -0x1.8bc2a4c3c7051p-55}},
        {1, {0x1.5bf0a8b145769p+1, 0x1.4d57ee2b1013ap-53}},
        {600, {0x1.88a122d234b39p+865, 0x1.2e21a5ab69fdfp+811}}})
    expect("exp", exp(x), value);
  for (const auto& [x, value] :
       {Known{0x1.56e1fc2f8f359p-997, {-0x1.5963447f87fb5p+9, -0x1.aa670d35324e6p-46}},
        {0x1.6a0902de00d1bp-1, {-0x1.62e6b3842a25ep-2, 0x1.ab287f524a622p-56}},
        {0x1.000001ad7f29bp+0, {0x1.ad7f2847b6492p-24, 0x1.d7f4a57fcf3ddp-80}},
        {10, {0x1.26bb1bbb55516p+1, -0x1.f48ad494ea3e9p-53}}})
    expect("log", log(Twofold(x)), value);
  for (const auto& [x, value] :
       {Known{0x1.4f8b588e368f1p-17, {0x1.4f8b588e06854p-17, -0x1.1497211c788bep-71}},
        {0x1.999999999999ap-2, {0x1.85a376b677dc0p-2, 0x1.05437130f10cdp-58}},
        {1, {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}},
        {0x1.34p+6, {0x1.8ecca397d2800p+0, -0x1.7019179733708p-54}}})
    expect("atan", atan(x), value);
}

TEST(Elementary, TwofoldsKeepWhatDoublesLose) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double a = random.between(-1, 1), b = random.between(-1, 1), c = random.between(1, 9);
    const Twofold x = Twofold::product(a, b) + c;
    EXPECT_LE(std::abs(double(x - c - a * Twofold(b))), 1e-31 * c);
    EXPECT_LE(std::abs(double(x / c * c - x)), 1e-30 * c);
    EXPECT_LE(std::abs(double(sqrt(x) * sqrt(x) - x)), 1e-30 * c);
    EXPECT_EQ(x.high + x.low, x.high);
  }
  EXPECT_EQ(double(Twofold::sum(1, 1e-20) - 1), 1e-20);
  EXPECT_LT(Twofold(1), Twofold(1, 1e-20));
}

// The same bits from every compiler, at every level of optimisation and on every machine.
TEST(Elementary, HasTheSameBitsEverywhere) {
  Random random(4);
  Hash bits;
  for (int i = 0; i < 2000; ++i) {
    const double x = random.between(-50, 50), y = random.between(-1, 1), large = any_double(random);
    for (const double v :
         {sin(x), cos(x), sin(large), tan(x), asin(y), atan(large), atan2(x, y), hypot(x, y, 2),
          log(std::abs(x)), log2(std::abs(y)), log10(std::abs(large)), pow(std::abs(x), 10 * y)})
      bits.add(v);
  }
  EXPECT_EQ(bits.value(), 3396635888961499660u);
}

}  // namespace
}  // namespace lantern::geometry
