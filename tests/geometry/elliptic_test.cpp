// Elliptic integrals and functions: values that others published or that were computed to forty
// digits (by mpmath), and what must hold of them: identities, closed forms at the ends, an integral
// summed plainly.
#include "geometry/elliptic.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.hpp"

namespace lantern::geometry {
namespace {

constexpr long double kUlp = std::numeric_limits<long double>::epsilon();
constexpr long double kPi = std::numbers::pi_v<long double>;

// Equal but for so many units of the last place. gtest compares doubles only.
void expect_equal(long double found, long double wanted, long double ulps = 4) {
  EXPECT_LE(std::abs(found - wanted), ulps * kUlp * std::abs(wanted))
      << "found " << static_cast<double>(found) << ", off by "
      << static_cast<double>((found - wanted) / wanted / kUlp) << " units of the last place";
}

struct First {
  long double x, y, z, value;
};
struct Third {
  long double x, y, z, p, value;
};

TEST(Elliptic, IntegralsOfTheFirstKindHaveKnownValues) {
  for (const First& k : {First{1, 2, 0, 1.31102877714605990523242L},  // Carlson 1995
                         {0.5L, 1, 0, 1.85407467730137191843385L},    // Carlson 1995
                         {2, 3, 4, 0.5840828416771517066928492L},     // Carlson 1995
                         {0.125L, 1, 30, 0.5119692823755310597556663L},
                         {7, 0.25L, 1e6L, 0.007148008361845641596062704L},
                         {0, 1, 0x1p-20L, 8.31776791141166998944495L}}) {
    expect_equal(carlson_rf<long double>(k.x, k.y, k.z), k.value);
    expect_equal(carlson_rf<long double>(k.z, k.x, k.y), k.value);
    expect_equal(carlson_rf<long double>(k.y, k.x, k.z), k.value);
    EXPECT_EQ(carlson_rf<long double>(4 * k.x, 4 * k.y, 4 * k.z),
              carlson_rf<long double>(k.x, k.y, k.z) / 2);
  }
  expect_equal(carlson_rf<long double>(7, 7, 7), 1 / std::sqrt(7.0L));
}

// As far apart as the series takes them without a step before it: each of its terms counts.
TEST(Elliptic, IntegralsOfTheFirstKindOfNearlyEqualNumbers) {
  constexpr long double s = 13 * 0x1p-17L;  // 1e-4
  for (const First& k : {First{1, -1, 0, 1.000000000983709473469617L},
                         {-1, 0, 1, 1.000000000983709473469617L},
                         {0, 1, -1, 1.000000000983709473469617L},
                         {-0.5L, -0.5L, 1, 1.000000000737764681774765L},
                         {1, -0.5L, -0.5L, 1.000000000737764681774765L},
                         {-0.5L, 1, -0.5L, 1.000000000737764681774765L},
                         {0.25L, 0.75L, -1, 1.000000000799277013508403L}})
    expect_equal(carlson_rf<long double>(1 + s * k.x, 1 + s * k.y, 1 + s * k.z), k.value, 0.75L);
}

TEST(Elliptic, IntegralsOfTheThirdKindHaveKnownValues) {
  for (const Third& k : {Third{0, 1, 2, 3, 0.7768862377858233201419028L},  // Carlson 1995
                         {2, 3, 4, 5, 0.1429757966715675383323388L},       // Carlson 1995
                         {0.125L, 1, 30, 0.5L, 0.577482423519572815683665L},
                         {7, 0.25L, 1000, 3, 0.018595321653613079967779L},
                         {1, 2, 3, 1.0078125L, 0.5567640048805408255490743L},
                         {3, 5, 0.5L, 40, 0.03494592218439077299751583L},
                         {2, 3, 4, 0.25L, 0.65272421868053131800052L},
                         {0, 1, 2, 1.5L, 1.330257431299327185765181L},
                         {2, 3, 4, 4, 0.1651052729426105334867134L},  // Carlson 1995: R_D(2, 3, 4)
                         {0, 2, 1, 1, 1.797210352103388311159884L},   // Carlson 1995: R_D(0, 2, 1)
                         {1, 1.25L, 1.5L, 1.125L, 0.7685847584774804841609826L},
                         {1, 2, 4, 2.25L, 0.3160063382763406356650284L},
                         {5, 0.5L, 0.75L, 0.625L, 0.9550662519801976380917382L}}) {
    expect_equal(carlson_rj<long double>(k.x, k.y, k.z, k.p), k.value);
    expect_equal(carlson_rj<long double>(k.z, k.x, k.y, k.p), k.value);
    expect_equal(carlson_rj<long double>(k.y, k.x, k.z, k.p), k.value);
    EXPECT_EQ(carlson_rj<long double>(4 * k.x, 4 * k.y, 4 * k.z, 4 * k.p),
              carlson_rj<long double>(k.x, k.y, k.z, k.p) / 8);
  }
  expect_equal(carlson_rj<long double>(7, 7, 7, 7), 1 / (7 * std::sqrt(7.0L)));
}

TEST(Elliptic, IntegralsOfTheThirdKindOfNearlyEqualNumbers) {
  constexpr long double s = 13 * 0x1p-17L;
  for (const Third& k : {Third{1, 1, 0, -1, 1.00000000421589775255253L},
                         {-1, -1, 0, 1, 1.00000000421589775255253L},
                         {-0.5L, 0.5L, 1, -0.5L, 1.000000002107908217836384L},
                         {1, 0, 1, -1, 1.00000000421589775255253L},
                         {0, 1, 1, -1, 1.00000000421589775255253L},
                         {1, -1, 0, 0, 1.000000002107948872977341L},
                         {1, -1, 1, -0.5L, 1.00000000368886987813622L},
                         {0.5L, 1, 0.5L, -1, 1.000000003688951183469956L},
                         {1, 1, -1, -0.5L, 1.00000000368886987813622L},
                         {-1, -0.5L, -0.25L, 0.875L, 1.000000002997229005383175L},
                         {-1, 0.5L, 1, -0.25L, 1.000000002503184204806648L}})
    expect_equal(carlson_rj<long double>(1 + s * k.x, 1 + s * k.y, 1 + s * k.z, 1 + s * k.p),
                 k.value, 1);
}

// R_C(x, y) = R_F(x, y, y) is an arctan, or an artanh, or what lies between them.
TEST(Elliptic, WithTwoEqualNumbersTheyAreElementary) {
  const auto rc = [](long double x, long double y) { return carlson_rf<long double>(x, y, y); };
  expect_equal(rc(0, 0.25L), kPi);
  expect_equal(rc(2.25L, 2), std::numbers::ln2_v<long double>);
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const long double x = random.between(0.1, 5), y = random.between(0.1, 5);
    const long double r = std::sqrt(std::abs(y - x));
    expect_equal(rc(x, y), (x < y ? std::atan(r / std::sqrt(x)) : std::atanh(r / std::sqrt(x))) / r,
                 x < y ? 4 : 4 + 4 / r);
    const long double p = random.between(0.1, 5);
    const long double difference = rc(x, y) - rc(x, p);
    expect_equal(carlson_rj<long double>(x, y, y, p), 3 * difference / (p - y),
                 8 + 8 * rc(x, y) / std::abs(difference));
  }
}

// A periodic integrand's sum over even steps is its integral to the last digit, of enough of them.
TEST(Elliptic, TheQuarterPeriodIsItsIntegral) {
  for (const long double m1 : {1.0L, 0.75L, 0.5L, 0.25L, 0.0625L}) {
    constexpr int kSteps = 256;
    long double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const long double s = std::sin(kPi / 2 * i / kSteps), c = std::cos(kPi / 2 * i / kSteps);
      sum += (1 / std::sqrt(m1 * s * s + c * c) + 1 / std::sqrt(s * s + m1 * c * c)) / 2;
    }
    expect_equal(quarter_period<long double>(m1), kPi / 2 * sum / kSteps, 16);
  }
  expect_equal(quarter_period<long double>(1), kPi / 2, 1);
  expect_equal(quarter_period<long double>(0.5L), 1.85407467730137191843385L);
  expect_equal(quarter_period<long double>(0x1p-40L), 15.24923797232203670878914L);
  expect_equal(quarter_period<long double>(0x1p-200L), 70.70101241711442156055768L);
  expect_equal(quarter_period<long double>(0x1p-40L), carlson_rf<long double>(0, 0x1p-40L, 1));
}

TEST(Elliptic, FunctionsHaveKnownValues) {
  struct Known {
    long double u, m1, sn, cn, dn;
  };
  for (const Known& k : {Known{0.5L, 0.5L, 0.4707504736556572833323919L,
                               0.8822663948904402864901554L, 0.9429724257773856872994509L},
                         {-1.25L, 0.25L, -0.8780214745055230318349417L,
                          0.4786212388801265562148904L, 0.6494680267190682701616777L},
                         {3, 0.5L, 0.6300289982420331644946371L, -0.7765716073705889562515469L,
                          0.8952830450126206237163942L},
                         {5.5L, 0.75L, -0.9262418368850820898631629L, 0.3769297807334265056313263L,
                          0.8862951059894989885238409L},
                         {1, 0x1p-30L, 0.7615941560353044493733799L, 0.6480542735704104122358418L,
                          0.648054273987189539757096L},
                         {-7, 0.0625L, 0.8937511877494853256749002L, -0.44856305509524993816884L,
                          0.5011319821131058255165079L},
                         {0.75L, 1 - 0x1p-40L, 0.6816387600232923666608772L,
                          0.7316888688738598271112791L, 0.9999999999997887101020905L}}) {
    const Jacobi<long double> f = jacobi<long double>(k.u, k.m1);
    expect_equal(f.sn, k.sn, 16);
    expect_equal(f.cn, k.cn, 16);
    expect_equal(f.dn, k.dn, 16);
  }
}

TEST(Elliptic, FunctionsKeepTheirIdentities) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const long double m1 =
        i % 2 == 0 ? std::pow(2.0L, -random.between(0, 60)) : random.between(0, 1);
    const long double quarter = quarter_period<long double>(m1),
                      u = quarter * random.between(-2, 2);
    SCOPED_TRACE(testing::Message()
                 << "u " << static_cast<double>(u) << ", m1 " << static_cast<double>(m1));
    const Jacobi<long double> f = jacobi<long double>(u, m1);
    expect_equal(f.sn * f.sn + f.cn * f.cn, 1, 8);
    expect_equal(f.dn * f.dn, f.cn * f.cn + m1 * f.sn * f.sn, 64);
    EXPECT_EQ(f.sn > 0, u > 0);
    EXPECT_EQ(f.cn > 0, std::abs(u) < quarter);
    // Near K, where sn stands still, the argument is as good as cn or dn tells it.
    EXPECT_LE(std::abs(argument_of<long double>(f, m1) - u), 64 * kUlp * quarter);
    const Jacobi<long double> back = jacobi<long double>(-u, m1),
                              half = jacobi<long double>(u + 2 * quarter, m1);
    EXPECT_EQ(back.sn, -f.sn);
    EXPECT_EQ(back.cn, f.cn);
    EXPECT_EQ(back.dn, f.dn);
    EXPECT_LE(std::abs(half.sn + f.sn), 64 * kUlp * quarter);
    EXPECT_LE(std::abs(half.cn + f.cn), 64 * kUlp * quarter);
  }
}

TEST(Elliptic, FunctionsAreElementaryAtTheEnds) {
  for (const long double u : {-2.0L, -0.25L, 0.0L, 1e-6L, 1.0L, 3.0L, 6.5L}) {
    const Jacobi<long double> round = jacobi<long double>(u, 1);
    expect_equal(round.sn, std::sin(u));
    expect_equal(round.cn, std::cos(u), 8);
    expect_equal(round.dn, 1, 1);
    if (u > 5) continue;
    const Jacobi<long double> straight =
        jacobi<long double>(u, 0x1p-100L);  // e^2u of it is less than the last digit
    expect_equal(straight.sn, std::tanh(u), 16);
    expect_equal(straight.cn, 1 / std::cosh(u), 16);
    expect_equal(straight.dn, 1 / std::cosh(u), 16);
  }
}

TEST(Elliptic, TheArgumentLiesWithinAPeriod) {
  const long double quarter = quarter_period<long double>(0.25L);
  EXPECT_EQ(argument_of<long double>({0, 1, 1}, 0.25L), 0);
  EXPECT_EQ(argument_of<long double>({0, -1, 1}, 0.25L), 2 * quarter) << "2 K, not -2 K";
  expect_equal(argument_of<long double>({1, 0, 0.5L}, 0.25L), quarter);
  expect_equal(argument_of<long double>({-1, 0, 0.5L}, 0.25L), -quarter);
}

}  // namespace
}  // namespace lantern::geometry
